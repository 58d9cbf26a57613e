#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <system_error>
#include <utility>

#include "system.h"

#if defined(__linux__)
#include <link.h>

#include <algorithm>
#elif defined(__APPLE__)
#include <mach-o/dyld.h>
#endif

namespace natator::system {

int process_id() {
    return ::getpid();
}

double memory_of_machine() {
    const double pages = static_cast<double>(::sysconf(_SC_PHYS_PAGES)),
                 page = static_cast<double>(::sysconf(_SC_PAGESIZE));
    return pages > 0 && page > 0 ? pages * page : std::numeric_limits<double>::max();
}

std::filesystem::path program_file() {
    std::error_code failed;
#if defined(__APPLE__)
    std::array<char, 4096> name{};
    auto size = static_cast<std::uint32_t>(name.size());
    return ::_NSGetExecutablePath(name.data(), &size) == 0 ? std::filesystem::canonical(name.data(), failed)
                                                           : std::filesystem::path();
#elif defined(__EMSCRIPTEN__)
    const char* const name = std::getenv("_");  // of the script; the running program is node or a browser
    return name ? std::filesystem::weakly_canonical(name, failed) : std::filesystem::path();
#else
    return std::filesystem::read_symlink("/proc/self/exe", failed);
#endif
}

#if defined(__linux__)
std::string build_id() {  // ELF note NT_GNU_BUILD_ID
    std::string id;
    const auto look = [](dl_phdr_info* info, std::size_t, void* found) {
        const auto here = reinterpret_cast<std::uintptr_t>(&build_id);
        const auto holds = [&](const ElfW(Phdr) & part) {
            return part.p_type == PT_LOAD && here - (info->dlpi_addr + part.p_vaddr) < part.p_memsz;
        };
        if (std::none_of(info->dlpi_phdr, info->dlpi_phdr + info->dlpi_phnum, holds)) return 0;
        for (int i = 0; i < info->dlpi_phnum; ++i) {
            if (info->dlpi_phdr[i].p_type != PT_NOTE) continue;
            // NOLINTNEXTLINE(performance-no-int-to-ptr): the loader tells addresses as numbers
            const char* at = reinterpret_cast<const char*>(info->dlpi_addr + info->dlpi_phdr[i].p_vaddr);
            const char* const end = at + info->dlpi_phdr[i].p_memsz;
            const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
            while (at + sizeof(ElfW(Nhdr)) <= end) {
                const auto* note = reinterpret_cast<const ElfW(Nhdr)*>(at);
                const char* const name = at + sizeof *note;
                const char* const content = name + padded(note->n_namesz);
                if (note->n_type == NT_GNU_BUILD_ID && std::string(name, note->n_namesz) == std::string("GNU\0", 4))
                    static_cast<std::string*>(found)->assign(content, note->n_descsz);
                at = content + padded(note->n_descsz);
            }
        }
        return 1;
    };
    dl_iterate_phdr(look, &id);
    return id;
}
#else
std::string build_id() {
    return {};
}
#endif

bool is_writable(const std::filesystem::path& path) {
    return ::access(path.c_str(), W_OK) == 0;
}

bool is_standard_output(const std::filesystem::path& file) {
    struct stat there{};
    if (::stat(file.c_str(), &there) != 0) return false;
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
        if (struct stat open{};
            ::fstat(stream, &open) == 0 && open.st_dev == there.st_dev && open.st_ino == there.st_ino)
            return true;
    return false;
}

bool is_output_terminal() {
    return ::isatty(STDOUT_FILENO) != 0;
}

void remove_file(const char* name) {
    ::unlink(name);
}

namespace {

void (*call_before_end)();

/// Reading and writing a stream that was closed fails as before.
void hold_closed_streams() {
    for (const auto& [stream, mode] :
         {std::pair(STDIN_FILENO, O_WRONLY), {STDOUT_FILENO, O_RDONLY}, {STDERR_FILENO, O_RDONLY}})
        if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
            ::open("/dev/null", mode);  // has the lowest number that is free
}

extern "C" void clean_up_and_end(int signal) {
    call_before_end();
    std::raise(signal);  // which ends the program as if there were no handler
}

}  // namespace

void prepare_program(void (*before_end)()) {
    hold_closed_streams();
    for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
    call_before_end = before_end;
    for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGXCPU}) {
        struct sigaction before{}, handler{};
        handler.sa_handler = clean_up_and_end;
        handler.sa_flags = SA_RESETHAND;
        if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_DFL)
            ::sigaction(signal, &handler, nullptr);
    }
}

void become(const std::string& program, char** arguments) {
    ::execv(program.c_str(), arguments);
}

FileLock::FileLock(const std::filesystem::path& file) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_CREAT, 0666);
    handle_ = descriptor;
    if (descriptor < 0)
        state_ = State::failed;
    else
        state_ = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK ? State::taken : State::locked;
}

FileLock::~FileLock() {
    if (handle_ >= 0) ::close(static_cast<int>(handle_));
}

Input::Input() {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    for (int k = 0; k < 2; ++k) {
        ::fcntl(ends[k], F_SETFD, FD_CLOEXEC);
        wake_[k] = ends[k];
    }
}

Input::~Input() {
    for (const std::intptr_t end : wake_) ::close(static_cast<int>(end));
}

std::size_t Input::read(char* buffer, std::size_t size) {
    for (;;) {
        std::array<pollfd, 2> files{{{STDIN_FILENO, POLLIN, 0}, {static_cast<int>(wake_[0]), POLLIN, 0}}};
        if (::poll(files.data(), files.size(), -1) < 0) {
            if (errno == EINTR) continue;
            error_ = errno;
            return 0;
        }
        if (files[1].revents != 0) return 0;
        const ssize_t count = ::read(STDIN_FILENO, buffer, size);
        if (count >= 0) return static_cast<std::size_t>(count);
        if (errno == EINTR || errno == EAGAIN) continue;
        if (errno != EBADF) error_ = errno;  // a closed one has nothing
        return 0;
    }
}

void Input::stop() {
    [[maybe_unused]] const ssize_t written = ::write(static_cast<int>(wake_[1]), "", 1);
}

}  // namespace natator::system
