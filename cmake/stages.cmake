# A stage is a folder of src/ as a static library. A stage without sources yet is an interface.
find_package(Threads REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Vulkan REQUIRED)
find_package(glfw3 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(meshoptimizer REQUIRED)

# Debian's OpenImageIOConfig.cmake pulls in Imath's Python bindings, which are not installed; the two libraries are all we need.
find_library(OPENIMAGEIO_LIBRARY OpenImageIO REQUIRED)
find_library(OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util REQUIRED)
find_path(OPENIMAGEIO_INCLUDE_DIR OpenImageIO/imageio.h REQUIRED)
find_path(IMATH_INCLUDE_DIR half.h PATH_SUFFIXES Imath REQUIRED)
add_library(relievo_openimageio INTERFACE)
target_link_libraries(relievo_openimageio INTERFACE ${OPENIMAGEIO_LIBRARY} ${OPENIMAGEIO_UTIL_LIBRARY})
target_include_directories(relievo_openimageio SYSTEM INTERFACE $<BUILD_INTERFACE:${OPENIMAGEIO_INCLUDE_DIR}> $<BUILD_INTERFACE:${IMATH_INCLUDE_DIR}>)

# Debian's libimgui.a holds the backends for GLFW and Vulkan; its font code lives in libstb. It has no CMake package.
find_library(IMGUI_LIBRARY imgui REQUIRED)
find_library(STB_LIBRARY stb REQUIRED)
find_path(IMGUI_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui REQUIRED)
# As an imported archive, so that what it needs comes after it on the linker's line.
add_library(relievo_imgui STATIC IMPORTED GLOBAL)
set_target_properties(relievo_imgui PROPERTIES
  IMPORTED_LOCATION ${IMGUI_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES ${IMGUI_INCLUDE_DIR}
  INTERFACE_LINK_LIBRARIES "${STB_LIBRARY};glfw;Vulkan::Vulkan")

# Highway 1.0 or later, for the CPU caster, which is left out where there is none (Ubuntu 22.04 has 0.16). Its CMake package on
# Debian names a folder of headers that does not exist.
find_library(HIGHWAY_LIBRARY hwy)
find_path(HIGHWAY_INCLUDE_DIR hwy/highway.h)
set(RELIEVO_HIGHWAY "")
if(HIGHWAY_LIBRARY AND HIGHWAY_INCLUDE_DIR)
  file(STRINGS ${HIGHWAY_INCLUDE_DIR}/hwy/base.h highway_version REGEX "define HWY_MAJOR [1-9]")
  if(NOT highway_version)
    file(STRINGS ${HIGHWAY_INCLUDE_DIR}/hwy/highway.h highway_version REGEX "define HWY_MAJOR [1-9]")
  endif()
  if(highway_version)
    set(RELIEVO_HIGHWAY ${HIGHWAY_LIBRARY})
  endif()
endif()
if(NOT RELIEVO_HIGHWAY)
  message(STATUS "the CPU caster (src/cast) is left out: it needs Highway 1.0 or later (libhwy-dev)")
endif()

# The programs' allocator: src/allocator says why. It takes the place of malloc by being there, though nobody names it. Sanitizers bring their own.
find_library(JEMALLOC_LIBRARY jemalloc REQUIRED)
set(RELIEVO_JEMALLOC "-Wl,--push-state,--no-as-needed,${JEMALLOC_LIBRARY},--pop-state")
if(RELIEVO_SANITIZE)
  set(RELIEVO_JEMALLOC "")
endif()

add_library(relievo_options INTERFACE)
target_compile_options(relievo_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow
  -Wno-missing-field-initializers  # designated initializers leave defaults out on purpose
 
  $<$<BOOL:${RELIEVO_WARNINGS_AS_ERRORS}>:-Werror>
  # Results must not depend on whether the compiler fuses a multiply with an add: CPU and GPU are compared bit by bit in places.
  -ffp-contract=off)
if(RELIEVO_SANITIZE)
  target_compile_options(relievo_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(relievo_options INTERFACE -fsanitize=address,undefined)
endif()

function(relievo_stage name)
  cmake_parse_arguments(STAGE "" "" "USES;THIRD_PARTY" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  list(TRANSFORM STAGE_USES PREPEND relievo_)
  if(NOT sources)
    add_library(relievo_${name} INTERFACE)
    set(scope INTERFACE)
  else()
    add_library(relievo_${name} STATIC ${sources})
    set(scope PUBLIC)
  endif()
  target_include_directories(relievo_${name} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)
  target_link_libraries(relievo_${name} ${scope} $<BUILD_INTERFACE:relievo_options> ${STAGE_USES} ${STAGE_THIRD_PARTY})
  if(EXISTS ${PROJECT_SOURCE_DIR}/src/${name}/main.cpp)
    add_executable(relievo ${PROJECT_SOURCE_DIR}/src/${name}/main.cpp)
    target_link_libraries(relievo PRIVATE relievo_allocator relievo_${name})
  endif()
endfunction()
