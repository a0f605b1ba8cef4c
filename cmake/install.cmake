# What other projects take: the program, the stages that need no device and no file formats, and the GLSL library.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(RELIEVO_LIBRARY_STAGES core techniques maps textures reference measure scenes)
if(TARGET relievo_cast)
  list(APPEND RELIEVO_LIBRARY_STAGES cast)
endif()
set(include_root ${CMAKE_INSTALL_INCLUDEDIR}/relievo)
set(shader_root ${CMAKE_INSTALL_DATADIR}/relievo/shaders)

foreach(stage ${RELIEVO_LIBRARY_STAGES})
  set_target_properties(relievo_${stage} PROPERTIES EXPORT_NAME ${stage})
  target_include_directories(relievo_${stage} PUBLIC $<INSTALL_INTERFACE:${include_root}>)
  install(TARGETS relievo_${stage} EXPORT relievo ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY src/${stage} DESTINATION ${include_root} FILES_MATCHING PATTERN "*.h")
endforeach()
target_include_directories(relievo_techniques PUBLIC $<INSTALL_INTERFACE:${shader_root}>)
install(FILES ${PROJECT_BINARY_DIR}/generated/techniques/heightfield_functions.h DESTINATION ${include_root})
install(FILES ${PROJECT_BINARY_DIR}/generated/core/version.h DESTINATION ${include_root}/core)
install(DIRECTORY shaders/ DESTINATION ${shader_root})
install(TARGETS relievo RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

install(EXPORT relievo NAMESPACE relievo:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/relievo FILE relievoTargets.cmake)
file(WRITE ${PROJECT_BINARY_DIR}/relievoConfig.cmake
  "include(CMakeFindDependencyMacro)\nfind_dependency(Threads)\ninclude(\${CMAKE_CURRENT_LIST_DIR}/relievoTargets.cmake)\n")
write_basic_package_version_file(${PROJECT_BINARY_DIR}/relievoConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/relievoConfig.cmake ${PROJECT_BINARY_DIR}/relievoConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/relievo)
