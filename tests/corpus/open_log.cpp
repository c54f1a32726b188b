// Preloaded into the programs under test: logs every file that they open, and every address they connect to.
// Calls inside the C library (the loader, locales) do not pass here, so the log has only what a program asked
// for.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/corpus/open_log.h"

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

// note: the code uses no part of the C++ library, so that preloading brings no other library along.
#define HEARTH_EXPORT extern "C" __attribute__((visibility("default")))

namespace
{

using hearth::corpus::kOpenFailed;
using hearth::corpus::kOpenForReading;
using hearth::corpus::kOpenForWriting;
using hearth::corpus::kOpenLogVariable;
using hearth::corpus::kOpenNetwork;

constexpr int kTextSize = 2 * PATH_MAX;

template <typename Function>
Function* next(const char* name)
{
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

void append(char kind, const char* text)
{
    const char* log = ::getenv(kOpenLogVariable);
    if (log == nullptr)
        return;
    char record[kTextSize + 2];
    const int size = std::snprintf(record, sizeof(record) - 1, "%c%s", kind, text);
    if (size <= 0)
        return;
    // one write with O_APPEND, including the closing zero: records of several processes do not mix
    const auto length = static_cast<size_t>(size < kTextSize ? size : kTextSize) + 1;
    const long file = ::syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0600);
    if (file < 0)
        return;
    ::syscall(SYS_write, file, record, length);
    ::syscall(SYS_close, file);
}

/// Return the real path of an open file, links resolved.
bool getPath(int file, char* path)
{
    char link[64];
    std::snprintf(link, sizeof(link), "/proc/self/fd/%d", file);
    const ssize_t length = ::readlink(link, path, PATH_MAX - 1);
    path[length > 0 ? length : 0] = '\0';
    return length > 0;
}

void logOpen(int folder, const char* path, bool writes, int opened)
{
    const int error = errno;
    char text[kTextSize];
    if (opened >= 0)
    {
        getPath(opened, text);
        append(writes ? kOpenForWriting : kOpenForReading, text);
    }
    else if (path != nullptr)
    {
        char base[PATH_MAX] = "";
        const bool relative = path[0] != '/';
        if (relative &&
            (folder == AT_FDCWD ? ::getcwd(base, sizeof(base)) == nullptr : !getPath(folder, base)))
            base[0] = '\0';
        std::snprintf(text, sizeof(text), "%s%s%s", base, relative ? "/" : "", path);
        append(kOpenFailed, text);
    }
    errno = error;
}

bool writes(int flags)
{
    return (flags & O_ACCMODE) != O_RDONLY || (flags & (O_CREAT | O_TRUNC)) != 0;
}

bool writes(const char* mode)
{
    return std::strpbrk(mode, "wa+") != nullptr;
}

int logged(int folder, const char* path, bool for_writing, int opened)
{
    logOpen(folder, path, for_writing, opened);
    return opened;
}

FILE* logged(const char* path, const char* mode, FILE* opened)
{
    logOpen(AT_FDCWD, path, writes(mode), opened == nullptr ? -1 : ::fileno(opened));
    return opened;
}

} // namespace

// open and its relatives, each under its two names. The last argument of open and openat is optional in C; on
// Linux it is passed in the same register either way, so these always take it.
#define HEARTH_LOG_OPEN(name)                                                                                \
    HEARTH_EXPORT int name##Logged(const char* path, int flags, mode_t mode) __asm__(#name);                 \
    int name##Logged(const char* path, int flags, mode_t mode)                                               \
    {                                                                                                        \
        static auto* const real = next<int(const char*, int, mode_t)>(#name);                                \
        return logged(AT_FDCWD, path, writes(flags), real(path, flags, mode));                               \
    }

#define HEARTH_LOG_OPENAT(name)                                                                              \
    HEARTH_EXPORT int name##Logged(int folder, const char* path, int flags, mode_t mode) __asm__(#name);     \
    int name##Logged(int folder, const char* path, int flags, mode_t mode)                                   \
    {                                                                                                        \
        static auto* const real = next<int(int, const char*, int, mode_t)>(#name);                           \
        return logged(folder, path, writes(flags), real(folder, path, flags, mode));                         \
    }

#define HEARTH_LOG_CREAT(name)                                                                               \
    HEARTH_EXPORT int name(const char* path, mode_t mode)                                                    \
    {                                                                                                        \
        static auto* const real = next<int(const char*, mode_t)>(#name);                                     \
        return logged(AT_FDCWD, path, true, real(path, mode));                                               \
    }

#define HEARTH_LOG_FOPEN(name)                                                                               \
    HEARTH_EXPORT FILE* name(const char* path, const char* mode)                                             \
    {                                                                                                        \
        static auto* const real = next<FILE*(const char*, const char*)>(#name);                              \
        return logged(path, mode, real(path, mode));                                                         \
    }

#define HEARTH_LOG_FREOPEN(name)                                                                             \
    HEARTH_EXPORT FILE* name(const char* path, const char* mode, FILE* stream)                               \
    {                                                                                                        \
        static auto* const real = next<FILE*(const char*, const char*, FILE*)>(#name);                       \
        return logged(path, mode, real(path, mode, stream));                                                 \
    }

HEARTH_LOG_OPEN(open)
HEARTH_LOG_OPEN(open64)
HEARTH_LOG_OPENAT(openat)
HEARTH_LOG_OPENAT(openat64)
HEARTH_LOG_CREAT(creat)
HEARTH_LOG_CREAT(creat64)
HEARTH_LOG_FOPEN(fopen)
HEARTH_LOG_FOPEN(fopen64)
HEARTH_LOG_FREOPEN(freopen)
HEARTH_LOG_FREOPEN(freopen64)

HEARTH_EXPORT DIR* opendir(const char* path)
{
    static auto* const real = next<DIR*(const char*)>("opendir");
    DIR* const opened = real(path);
    logOpen(AT_FDCWD, path, false, opened == nullptr ? -1 : ::dirfd(opened));
    return opened;
}

HEARTH_EXPORT int connect(int socket, const sockaddr* address, socklen_t length)
{
    static auto* const real = next<int(int, const sockaddr*, socklen_t)>("connect");
    append(kOpenNetwork, "a network address");
    return real(socket, address, length);
}
