# Writes OUTPUT, a header that names the commit SOURCE was built from: 12 hexadecimal digits, with "-modified" after them
# if tracked files differ from it; "unknown" outside a repository of its own. Run at every build; leaves a header that is
# right as it is, so that nothing is compiled anew.
#   cmake -D SOURCE=folder -D OUTPUT=file -P commit.cmake
set(commit unknown)
# A prefix would mean that an unpacked archive lies in some other repository.
execute_process(COMMAND git rev-parse --show-prefix WORKING_DIRECTORY ${SOURCE}
    OUTPUT_VARIABLE prefix RESULT_VARIABLE status OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(status EQUAL 0 AND prefix STREQUAL "")
    execute_process(COMMAND git describe --always --exclude=* --abbrev=12 --dirty=-modified WORKING_DIRECTORY ${SOURCE}
        OUTPUT_VARIABLE described RESULT_VARIABLE status OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(status EQUAL 0)
        set(commit ${described})
    endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define NATATOR_COMMIT \"${commit}\"\n")
