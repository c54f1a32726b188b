// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/corpus/run_process.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hearth::corpus
{

namespace
{

using Clock = std::chrono::steady_clock;

// Poll interval. Filling memory takes about 0.5 s a GiB, so a program exceeds its limit by a few dozen MiB
// before it is noticed.
constexpr int kPollMilliseconds = 25;

std::vector<char*> pointers(const std::vector<std::string>& texts)
{
    std::vector<char*> result;
    result.reserve(texts.size() + 1);
    for (const std::string& text : texts)
        result.push_back(const_cast<char*>(text.c_str()));
    result.push_back(nullptr);
    return result;
}

bool sameVariable(const std::string& entry, const char* other)
{
    const size_t name = entry.find('=') + 1;
    return entry.compare(0, name, other, std::min(name, std::strlen(other))) == 0;
}

/// Return this process's environment with `added` in place of variables of the same name.
std::vector<std::string> environmentWith(const std::vector<std::string>& added)
{
    std::vector<std::string> result = added;
    for (char** entry = environ; *entry != nullptr; ++entry)
        if (std::none_of(added.begin(), added.end(),
                         [&](const std::string& text) { return sameVariable(text, *entry); }))
            result.emplace_back(*entry);
    return result;
}

pid_t start(const Command& command)
{
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    constexpr int kCreate = O_WRONLY | O_CREAT | O_TRUNC;
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, command.stdout_file.c_str(), kCreate, 0600);
    ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, command.stderr_file.c_str(), kCreate, 0600);
    ::posix_spawn_file_actions_addchdir_np(&actions, command.folder.c_str());
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);

    const std::vector<std::string> environment = environmentWith(command.environment);
    pid_t process = -1;
    const int error = ::posix_spawn(&process, command.arguments[0].c_str(), &actions, &attributes,
                                    pointers(command.arguments).data(), pointers(environment).data());
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    return error == 0 ? process : -1;
}

/// Return the resident bytes of process `name` of /proc if it belongs to the group, else 0.
uint64_t residentBytes(const char* name, pid_t group)
{
    char path[64];
    std::snprintf(path, sizeof(path), "/proc/%.20s/stat", name);
    char text[1024];
    const int file = ::open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return 0;
    const ssize_t size = ::read(file, text, sizeof(text) - 1);
    ::close(file);
    text[std::max<ssize_t>(size, 0)] = '\0';
    // the name in parentheses may hold anything: the fields start after the last parenthesis
    const char* field = std::strrchr(text, ')');
    int process_group = 0;
    long pages = 0;
    if (field == nullptr ||
        std::sscanf(
            field, ") %*c %*d %d %*d %*d %*d %*u %*u %*u %*u %*u %*u %*u %*d %*d %*d %*d %*d %*d %*u %*u %ld",
            &process_group, &pages) != 2)
        return 0;
    return process_group == group ? static_cast<uint64_t>(pages) * static_cast<uint64_t>(::getpagesize()) : 0;
}

uint64_t residentBytes(pid_t group)
{
    uint64_t sum = 0;
    DIR* const processes = ::opendir("/proc");
    if (processes == nullptr)
        return 0;
    while (const dirent* entry = ::readdir(processes))
        if (std::isdigit(static_cast<unsigned char>(entry->d_name[0])) != 0)
            sum += residentBytes(entry->d_name, group);
    ::closedir(processes);
    return sum;
}

/// Wait for the process to end or to exceed a limit, then kill the rest of its group.
void watch(pid_t process, const Limits& limits, Clock::time_point begin, ProcessEnd& end)
{
    // glibc 2.36 declares pidfd_open in a way that C++ cannot link to
    const int handle = static_cast<int>(::syscall(SYS_pidfd_open, process, 0));
    HEARTH_ASSERT(handle >= 0);
    pollfd waits{handle, POLLIN, 0};
    while (::poll(&waits, 1, kPollMilliseconds) <= 0)
    {
        end.peak_rss_bytes = std::max(end.peak_rss_bytes, residentBytes(process));
        end.over_memory = end.peak_rss_bytes > limits.rss_bytes;
        end.over_time = std::chrono::duration<double>(Clock::now() - begin).count() > limits.seconds;
        if (end.over_memory || end.over_time)
            break;
    }
    ::close(handle);
    // not reaped yet, so that its process id cannot be reused
    ::kill(-process, SIGKILL);
}

/// Reap any process of the group and include its peak memory.
pid_t reap(pid_t which, int& status, ProcessEnd& end)
{
    rusage usage{};
    pid_t reaped = -1;
    do
        reaped = ::wait4(which, &status, 0, &usage);
    while (reaped < 0 && errno == EINTR);
    if (reaped > 0)
        end.peak_rss_bytes = std::max(end.peak_rss_bytes, static_cast<uint64_t>(usage.ru_maxrss) * 1024);
    return reaped;
}

} // namespace

void adoptOrphans()
{
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
}

ProcessEnd runProcess(const Command& command, const Limits& limits)
{
    ProcessEnd end;
    const Clock::time_point begin = Clock::now();
    const pid_t process = start(command);
    if (process < 0)
        return end;
    end.started = true;
    watch(process, limits, begin, end);

    int status = 0;
    reap(process, status, end);
    end.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;

    int orphan_status = 0;
    while (reap(-process, orphan_status, end) > 0)
        end.left_processes = true;
    end.over_memory = end.over_memory || end.peak_rss_bytes > limits.rss_bytes;
    return end;
}

} // namespace hearth::corpus
