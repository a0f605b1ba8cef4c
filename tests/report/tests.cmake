# The page in a real browser. Skipped, with a message, where there is none.
find_program(RELIEVO_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)  # the system's: that is where python3-selenium installs
if(RELIEVO_PYTHON)
  add_test(NAME report.browser
    COMMAND ${RELIEVO_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/browser_test.py $<TARGET_FILE:test_report> ${PROJECT_BINARY_DIR}/tests/browser)
  set_tests_properties(report.browser PROPERTIES LABELS browser SKIP_RETURN_CODE 77 TIMEOUT 300)
endif()
