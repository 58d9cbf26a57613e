#if !defined(NOMINMAX)
#define NOMINMAX
#endif
#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <process.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <limits>

#include "system.h"

namespace natator::system {
namespace {

HANDLE as_handle(std::intptr_t number) {
    return reinterpret_cast<HANDLE>(number);
}

/// Which file a handle is of; `file` is all 0 where the system does not tell.
BY_HANDLE_FILE_INFORMATION identity(HANDLE handle) {
    BY_HANDLE_FILE_INFORMATION file{};
    if (!::GetFileInformationByHandle(handle, &file)) file = {};
    return file;
}

void (*call_before_end)();

extern "C" void clean_up_and_end(int signal) {
    call_before_end();
    std::raise(signal);  // the handler is no longer set
}

}  // namespace

int process_id() {
    return ::_getpid();
}

double memory_of_machine() {
    MEMORYSTATUSEX memory{};
    memory.dwLength = sizeof memory;
    return ::GlobalMemoryStatusEx(&memory) ? static_cast<double>(memory.ullTotalPhys)
                                           : std::numeric_limits<double>::max();
}

std::filesystem::path program_file() {
    std::array<wchar_t, 32768> name{};
    return {name.data(), name.data() + ::GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size()))};
}

std::string build_id() {
    return {};
}

bool is_writable(const std::filesystem::path& path) {
    return ::_waccess(path.c_str(), 2) == 0;
}

bool is_standard_output(const std::filesystem::path& file) {
    constexpr DWORD any = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    const HANDLE there = ::CreateFileW(file.c_str(), 0, any, nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (there == INVALID_HANDLE_VALUE) return false;
    const auto wanted = identity(there);
    ::CloseHandle(there);
    for (const DWORD stream : {STD_OUTPUT_HANDLE, STD_ERROR_HANDLE}) {
        const auto open = identity(::GetStdHandle(stream));
        if (open.dwVolumeSerialNumber == wanted.dwVolumeSerialNumber && open.nFileIndexHigh == wanted.nFileIndexHigh &&
            open.nFileIndexLow == wanted.nFileIndexLow && open.nNumberOfLinks > 0)
            return true;
    }
    return false;
}

bool is_output_terminal() {
    return ::_isatty(1) != 0;
}

void remove_file(const char* name) {
    ::_unlink(name);
}

void prepare_program(void (*before_end)()) {
    for (const int stream : {0, 1}) ::_setmode(stream, _O_BINARY);  // lines end as elsewhere
    call_before_end = before_end;
    for (const int signal : {SIGTERM, SIGINT}) std::signal(signal, clean_up_and_end);
}

void become(const std::string&, char**) {
    errno = ENOSYS;
}

FileLock::FileLock(const std::filesystem::path& file) {
    const HANDLE handle = ::CreateFileW(file.c_str(), GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr,
                                        OPEN_ALWAYS, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (handle == INVALID_HANDLE_VALUE) {
        errno = ::GetLastError() == ERROR_PATH_NOT_FOUND ? ENOENT : EACCES;
        state_ = State::failed;
        return;
    }
    handle_ = reinterpret_cast<std::intptr_t>(handle);
    OVERLAPPED behind_all{};  // a byte that no file has, so that the file itself may be read and written
    behind_all.OffsetHigh = 0x7fffffff;
    const bool locked = ::LockFileEx(handle, LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &behind_all);
    state_ = !locked && ::GetLastError() == ERROR_LOCK_VIOLATION ? State::taken : State::locked;
}

FileLock::~FileLock() {
    if (handle_ != -1) ::CloseHandle(as_handle(handle_));
}

Input::Input() = default;

Input::~Input() {
    if (wake_[0] != -1) ::CloseHandle(as_handle(wake_[0]));
}

std::size_t Input::read(char* buffer, std::size_t size) {
    if (wake_[0] == -1) {
        HANDLE self = nullptr;
        ::DuplicateHandle(::GetCurrentProcess(), ::GetCurrentThread(), ::GetCurrentProcess(), &self, 0, FALSE,
                          DUPLICATE_SAME_ACCESS);
        wake_[0] = reinterpret_cast<std::intptr_t>(self);
    }
    DWORD count = 0;
    reading_ = true;  // before it asks whether it is stopped: stop() sees one or the other
    if (!stopped_ && !::ReadFile(::GetStdHandle(STD_INPUT_HANDLE), buffer, static_cast<DWORD>(size), &count, nullptr))
        count = 0;
    reading_ = false;
    return count;
}

void Input::stop() {
    stopped_ = true;
    while (reading_) {
        ::CancelSynchronousIo(as_handle(wake_[0]));
        ::Sleep(1);
    }
}

}  // namespace natator::system
