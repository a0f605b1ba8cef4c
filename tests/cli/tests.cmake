# These tests run the program itself.
add_dependencies(test_cli relievo)
