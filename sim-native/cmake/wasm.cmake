# WebAssembly, by Debian's emscripten, run by node or a browser: ./setup.sh --wasm
set(CMAKE_CROSSCOMPILING_EMULATOR node)
# Debian's headers of Eigen, nlohmann-json and CLI11, without those of its C library beside them.
foreach(part include/eigen3 include/nlohmann include/CLI share/eigen3 share/cmake/nlohmann_json share/cmake/CLI11)
    cmake_path(GET part PARENT_PATH folder)
    file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/headers/${folder})
    file(CREATE_LINK /usr/${part} ${CMAKE_BINARY_DIR}/headers/${part} SYMBOLIC)
endforeach()
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
list(APPEND CMAKE_FIND_ROOT_PATH ${CMAKE_BINARY_DIR}/headers)
string(APPEND CMAKE_CXX_FLAGS_INIT " -msimd128 -fwasm-exceptions")
# Where Debian's emscripten has its JavaScript packages; a node from elsewhere does not look there.
set_property(GLOBAL PROPERTY RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")
