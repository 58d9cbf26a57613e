#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

/// What the programs ask the operating system for beyond the C++ library: in system_posix.cpp and system_windows.cpp.
namespace natator::system {

int process_id();

/// Bytes; the largest number where the system does not tell.
double memory_of_machine();

/// The file of the program that runs; empty where the system does not tell.
std::filesystem::path program_file();

/// The build id that the linker put into the program or shared library that holds this function: a digest of all its
/// code. Empty without one.
std::string build_id();

/// Whether a file may be written, or a folder take new files. If not, errno says why.
bool is_writable(const std::filesystem::path& path);

/// Whether standard output or standard error goes to this file.
bool is_standard_output(const std::filesystem::path& file);

/// Whether standard output is a terminal.
bool is_output_terminal();

/// Removes a file; may be called by a handler of a signal.
void remove_file(const char* name);

/// For the beginning of a program. What is opened later has the number of no standard stream, even if that is closed. A
/// closed pipe and a file that is larger than it may be are errors of who writes, not a death. A signal that ends the
/// program calls `before_end`, unless it is ignored, as under nohup.
void prepare_program(void (*before_end)());

/// Becomes another program with these arguments, the first of which is its name and the last null. Returns only if that
/// fails; errno then says why.
void become(const std::string& program, char** arguments);

/// A file that is locked for this process, until this is destroyed.
class FileLock {
public:
    enum class State { locked, taken, failed };

    /// Makes the file if it is not there. `failed`: it could not be opened, errno says why; `taken`: another process
    /// has it. On a file system without locks it counts as locked.
    explicit FileLock(const std::filesystem::path& file);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

    State state() const { return state_; }

private:
    State state_ = State::locked;
    std::intptr_t handle_ = -1;
};

/// Standard input, read by one thread until another stops it.
class Input {
public:
    Input();  ///< throws std::system_error when the system has no room for it
    ~Input();
    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;

    /// Waits until there is something to read, and reads at most `size` bytes. 0 at the end of the stream, and once it
    /// is stopped.
    std::size_t read(char* buffer, std::size_t size);
    /// errno of a read that failed, and returned 0 for that; 0 if none has.
    int error() const { return error_; }
    /// Ends a read, and makes all further ones return 0.
    void stop();

private:
    std::intptr_t wake_[2] = {-1,
                              -1};  ///< on POSIX a pipe, readable once it is stopped; on Windows the thread that reads
    std::atomic<bool> stopped_ = false, reading_ = false;
    std::atomic<int> error_ = 0;
};

}  // namespace natator::system
