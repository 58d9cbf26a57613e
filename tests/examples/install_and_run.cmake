# Installs the build BUILD into a prefix below WORK, moves the prefix, and does there what docs/library.md says:
# configures and builds the examples of SOURCE against it, and runs them. Any step that fails ends it.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/package.cmake)

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
file(RENAME ${WORK}/first ${WORK}/prefix)

# No header needs nlohmann/json, and no file of the package knows where the sources were.
file(GLOB headers ${WORK}/prefix/include/natator/*.h)
file(GLOB package ${WORK}/prefix/lib*/cmake/natator/*.cmake ${WORK}/prefix/lib*/*/cmake/natator/*.cmake)
foreach(file ${headers})
    file(STRINGS ${file} found REGEX nlohmann)
    if(found)
        message(FATAL_ERROR "${file}: ${found}")
    endif()
endforeach()
string(REGEX REPLACE "([][+.*()^$?|\\\\])" "\\\\\\1" source_regex ${SOURCE})
set(programs)
if(OPTIMISED)  # others hold the paths of asserts and of debugging
    file(GLOB programs ${WORK}/prefix/bin/* ${WORK}/prefix/lib*/*.a)
endif()
foreach(file ${package} ${programs})
    file(STRINGS ${file} found REGEX ${source_regex})
    if(found)
        message(FATAL_ERROR "${file} names the source tree: ${found}")
    endif()
endforeach()

run(${CMAKE_COMMAND} -E env --unset=NATATOR_DATA ${WORK}/prefix/bin/natator-sim info)
expect("thesis/creature-1\n")
string(REGEX MATCH "schemas +([^\n]+)" schemas "${output}")
if(NOT EXISTS ${CMAKE_MATCH_1}/scene.schema.json)
    message(FATAL_ERROR "no scene.schema.json in ${CMAKE_MATCH_1}")
endif()

run_against(${WORK}/prefix ${WORK}/build)
