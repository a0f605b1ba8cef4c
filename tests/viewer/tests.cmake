# The built program in a window on a virtual display. Skipped, with a message, where there is no Xvfb or no software Vulkan.
find_program(RELIEVO_PYTHON NAMES python3)
if(RELIEVO_PYTHON)
  add_test(NAME viewer.window
    COMMAND ${RELIEVO_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/window_test.py $<TARGET_FILE:relievo> ${PROJECT_BINARY_DIR}/tests/window)
  set_tests_properties(viewer.window PROPERTIES LABELS window SKIP_RETURN_CODE 77 TIMEOUT 300
    ENVIRONMENT "${RELIEVO_DEVICE_ENVIRONMENT}")
endif()
