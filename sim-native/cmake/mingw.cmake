# Windows on x86-64, by Debian's cross compiler, run by wine: sudo apt-get install g++-mingw-w64-x86-64-posix wine64
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_CROSSCOMPILING_EMULATOR /usr/lib/wine/wine64)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
# Debian's headers of Eigen, nlohmann-json and CLI11, without those of its C library beside them.
foreach(part include/eigen3 include/nlohmann include/CLI share/eigen3 share/cmake/nlohmann_json share/cmake/CLI11)
    cmake_path(GET part PARENT_PATH folder)
    file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/headers/${folder})
    file(CREATE_LINK /usr/${part} ${CMAKE_BINARY_DIR}/headers/${part} SYMBOLIC)
endforeach()
set(CMAKE_FIND_ROOT_PATH ${CMAKE_BINARY_DIR}/headers)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
