# Natator as a part of the project in added/: what that one builds, tests and installs is its own, and the library at most. With
# SUBDIRECTORY the library is a shared one, whose package the examples are built against, too.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/package.cmake)

function(expect_equal what found expected)
    if(NOT "${found}" STREQUAL "${expected}")
        message(FATAL_ERROR "${what}: ${found}; expected: ${expected}")
    endif()
endfunction()

unset(ENV{CXXFLAGS})  # of whoever runs the test
file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/added -B ${WORK}/build -G Ninja -D CMAKE_BUILD_TYPE=Release
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_EXPORT_COMPILE_COMMANDS=ON -D SOURCE=${SOURCE} -D SUBDIRECTORY=${SUBDIRECTORY}
    -D BUILD_SHARED_LIBS=${SUBDIRECTORY}
    -D CMAKE_CXX_FLAGS_RELEASE=-O0)  # what is looked at needs no speed, and is compiled sooner
file(GLOB made RELATIVE ${WORK}/build ${WORK}/build/bin ${WORK}/build/share)
expect_equal("folders of Natator in that of the project" "${made}" "")

# What `cmake --build` would build: no program of Natator's.
run(${CMAKE_COMMAND} --build ${WORK}/build -- -n -v)
string(REGEX MATCHALL "natator-(sim|bench|data|tests|studies)" others "${output}")
expect_equal("targets of Natator in \"all\"" "${others}" "")
if(SUBDIRECTORY)
    expect("libnatator\\.so")
else()
    expect("libnatator\\.a")
endif()

run(${CMAKE_COMMAND} --build ${WORK}/build --target fish)
run(${CMAKE_CTEST_COMMAND} --test-dir ${WORK}/build)
expect("100% tests passed, 0 tests failed out of 1\n")

run(${CMAKE_COMMAND} --install ${WORK}/build --prefix ${WORK}/prefix)
file(GLOB_RECURSE installed RELATIVE ${WORK}/prefix ${WORK}/prefix/*)
expect_equal("installed" "${installed}" "games/fish")

# The project's own sources are compiled as if Natator were not there.
file(READ ${WORK}/build/compile_commands.json commands)
string(REGEX MATCH "\"command\": \"([^\"]*fish\\.cpp)\"" command "${commands}")
if(CMAKE_MATCH_1 MATCHES "-W|-std|-m|EIGEN|natator/")
    message(FATAL_ERROR "fish.cpp is compiled by ${CMAKE_MATCH_1}; expected the project's own options")
endif()

if(SUBDIRECTORY)
    run(${CMAKE_COMMAND} -D NATATOR_INSTALL=ON ${WORK}/build)
    run(${CMAKE_COMMAND} --build ${WORK}/build --target natator)
    run(${CMAKE_COMMAND} --install ${WORK}/build --prefix ${WORK}/first)
    file(RENAME ${WORK}/first ${WORK}/natator)
    run_against(${WORK}/natator ${WORK}/examples)
endif()
