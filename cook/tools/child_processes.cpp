// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/child_processes.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hearth::tools
{

namespace
{

// A child that writes more than this is broken; the rest is read and forgotten.
constexpr size_t kMaxMessages = size_t{1} << 20;

double secondsOf(const timeval& time)
{
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

/// Attributes and file actions of posix_spawn, given back when they go.
struct SpawnSetup
{
    SpawnSetup(const sigset_t& signals, int messages_pipe)
    {
        ::posix_spawnattr_init(&attributes);
        ::posix_spawnattr_setsigmask(&attributes, &signals);
        ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
        ::posix_spawn_file_actions_init(&actions);
        ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        ::posix_spawn_file_actions_adddup2(&actions, messages_pipe, STDERR_FILENO);
    }
    SpawnSetup(const SpawnSetup&) = delete;
    SpawnSetup& operator=(const SpawnSetup&) = delete;
    ~SpawnSetup()
    {
        ::posix_spawn_file_actions_destroy(&actions);
        ::posix_spawnattr_destroy(&attributes);
    }
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_t actions;
};

Error cannotStart(const std::string& program, int error)
{
    return {Issue::child_failed, program, "", std::string("cannot be started: ") + std::strerror(error)};
}

} // namespace

ChildProcesses::ChildProcesses()
{
    sigset_t signals;
    ::sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD})
        ::sigaddset(&signals, signal);
    ::sigprocmask(SIG_BLOCK, &signals, &old_signals_);
    signal_file_ = ::signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
    HEARTH_ASSERT(signal_file_ >= 0);
}

ChildProcesses::~ChildProcesses()
{
    for (const Child& child : children_)
    {
        // nothing to save: what a cooker has written so far is of no use
        ::kill(child.process, SIGKILL);
        ::waitpid(child.process, nullptr, 0);
        if (child.messages_pipe >= 0)
            ::close(child.messages_pipe);
    }
    ::close(signal_file_);
    ::sigprocmask(SIG_SETMASK, &old_signals_, nullptr);
}

Result<size_t> ChildProcesses::start(const std::vector<std::string>& command)
{
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
        return cannotStart(command[0], errno);
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);

    std::vector<char*> arguments;
    for (const std::string& argument : command)
        arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);

    const SpawnSetup setup(old_signals_, ends[1]);
    Child child;
    child.start = std::chrono::steady_clock::now();
    const int error = ::posix_spawn(&child.process, command[0].c_str(), &setup.actions, &setup.attributes,
                                    arguments.data(), environ);
    ::close(ends[1]);
    if (error != 0)
    {
        ::close(ends[0]);
        return cannotStart(command[0], error);
    }
    child.id = next_id_++;
    child.messages_pipe = ends[0];
    children_.push_back(std::move(child));
    return children_.back().id;
}

void ChildProcesses::drain(Child& child)
{
    char buffer[4096];
    while (child.messages_pipe >= 0)
    {
        const ssize_t size = ::read(child.messages_pipe, buffer, sizeof(buffer));
        if (size < 0 && errno == EINTR)
            continue;
        if (size < 0)
            return;
        if (size == 0)
        {
            // poll leaves out what is negative, and would not wait on a pipe that has ended
            ::close(child.messages_pipe);
            child.messages_pipe = -1;
            return;
        }
        const size_t room = kMaxMessages - child.messages.size();
        child.messages.append(buffer, std::min(room, static_cast<size_t>(size)));
    }
}

std::optional<ChildEnd> ChildProcesses::reapOne()
{
    for (auto child = children_.begin(); child != children_.end(); ++child)
    {
        int status = 0;
        rusage usage{};
        if (::wait4(child->process, &status, WNOHANG, &usage) != child->process)
            continue;
        drain(*child);
        ChildEnd end;
        end.id = child->id;
        end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
        end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
        end.messages = std::move(child->messages);
        end.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - child->start).count();
        end.cpu_seconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
        end.peak_rss_bytes = static_cast<uint64_t>(usage.ru_maxrss) * 1024;
        if (child->messages_pipe >= 0)
            ::close(child->messages_pipe);
        children_.erase(child);
        return end;
    }
    return std::nullopt;
}

std::optional<ChildEnd> ChildProcesses::wait()
{
    HEARTH_ASSERT(!children_.empty());
    for (;;)
    {
        if (std::optional<ChildEnd> end = reapOne())
            return end;

        std::vector<pollfd> files{{signal_file_, POLLIN, 0}};
        for (const Child& child : children_)
            files.push_back({child.messages_pipe, POLLIN, 0});
        ::poll(files.data(), files.size(), -1);
        for (Child& child : children_)
            drain(child);
        signalfd_siginfo signal{};
        while (::read(signal_file_, &signal, sizeof(signal)) == sizeof(signal))
            if (signal.ssi_signo != SIGCHLD)
                return std::nullopt;
    }
}

std::string programFolder()
{
    std::error_code error;
    return std::filesystem::read_symlink("/proc/self/exe", error).parent_path().string();
}

} // namespace hearth::tools
