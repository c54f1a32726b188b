// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/child_processes.h"

#include "cook/json/json.h"
#include "cook/tools/batch.h"
#include "formats/base/flush.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hearth::tools
{

namespace
{

// Interval at which wait() calls back, and polls for children whose end no file descriptor reports.
constexpr int kPollInterval_ms = 100;

// Most message bytes that are stored. A child that writes more is broken; the rest is read and discarded.
constexpr size_t kMaxMessages = size_t{1} << 20;

double toSeconds(const timeval& time)
{
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

/// Attributes and file actions of posix_spawn; the destructor frees them.
struct SpawnSetup
{
    /// work  stdin of a batch; negative: no batch. A batch writes its reports to the pipe of its messages:
    ///       messages before a report belong to that report's command line
    SpawnSetup(const sigset_t& signals, int messages_pipe, int work)
    {
        ::posix_spawnattr_init(&attributes);
        ::posix_spawnattr_setsigmask(&attributes, &signals);
        ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
        ::posix_spawn_file_actions_init(&actions);
        if (work < 0)
        {
            ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
            ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        }
        else
        {
            ::posix_spawn_file_actions_adddup2(&actions, work, STDIN_FILENO);
            ::posix_spawn_file_actions_adddup2(&actions, messages_pipe, STDOUT_FILENO);
        }
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

void closeFile(int& file)
{
    if (file >= 0)
        ::close(file);
    file = -1;
}

Error cannotStart(const std::string& program, int error)
{
    return {Issue::child_failed, program, "", std::string("cannot be started: ") + std::strerror(error)};
}

} // namespace

ChildProcesses::ChildProcesses()
{
    sigset_t signals;
    ::sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        ::sigaddset(&signals, signal);
    ::sigprocmask(SIG_BLOCK, &signals, &old_signals_);
    signal_file_ = ::signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
    HEARTH_ASSERT(signal_file_ >= 0);
}

ChildProcesses::~ChildProcesses()
{
    for (Child& child : children_)
    {
        // nothing to save: partial output of a cooker is of no use
        ::kill(child.process, SIGKILL);
        ::waitpid(child.process, nullptr, 0);
        closeFile(child.pidfd);
        closeFile(child.messages_pipe);
        closeFile(child.work_socket);
    }
    closeFile(signal_file_);
    ::sigprocmask(SIG_SETMASK, &old_signals_, nullptr);
}

Result<size_t> ChildProcesses::start(const std::vector<std::string>& command)
{
    return start(command, false);
}

Result<size_t> ChildProcesses::startBatch(const std::string& program)
{
    return start({program, "--batch"}, true);
}

Result<size_t> ChildProcesses::start(const std::vector<std::string>& command, bool is_batch)
{
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
        return cannotStart(command[0], errno);
    // a socket, not a pipe: writing to a pipe whose reader has died raises a signal
    int work[2] = {-1, -1};
    if (is_batch && ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, work) != 0)
    {
        const int error = errno;
        ::close(ends[0]);
        ::close(ends[1]);
        return cannotStart(command[0], error);
    }
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);

    std::vector<char*> arguments;
    for (const std::string& argument : command)
        arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);

    std::string no_flush = std::string(kFlushEnvironmentVariable) + "=off";
    std::vector<char*> environment{no_flush.data()};
    for (char** variable = environ; *variable != nullptr; ++variable)
        environment.push_back(*variable);
    environment.push_back(nullptr);

    const SpawnSetup setup(old_signals_, ends[1], work[1]);
    Child child;
    child.start = std::chrono::steady_clock::now();
    const int error = ::posix_spawn(&child.process, command[0].c_str(), &setup.actions, &setup.attributes,
                                    arguments.data(), environment.data());
    ::close(ends[1]);
    closeFile(work[1]);
    if (error != 0)
    {
        ::close(ends[0]);
        closeFile(work[0]);
        return cannotStart(command[0], error);
    }
    child.id = next_id_++;
    // without <sys/pidfd.h>: the header of glibc 2.36 cannot be used from C++
    child.pidfd = static_cast<int>(::syscall(SYS_pidfd_open, child.process, 0));
    child.messages_pipe = ends[0];
    child.work_socket = work[0];
    child.is_batch = is_batch;
    children_.push_back(std::move(child));
    return children_.back().id;
}

/// Find a running child; null if it has ended, whether wait() has reported that or not.
ChildProcesses::Child* ChildProcesses::find(size_t id)
{
    const auto found =
        std::find_if(children_.begin(), children_.end(), [&](const Child& child) { return child.id == id; });
    return found == children_.end() ? nullptr : &*found;
}

void ChildProcesses::sendCommandLine(size_t id, std::string_view line)
{
    Child* child = find(id);
    while (child != nullptr && !line.empty())
    {
        const ssize_t sent = ::send(child->work_socket, line.data(), line.size(), MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent < 0)
            return;
        line.remove_prefix(static_cast<size_t>(sent));
    }
}

void ChildProcesses::close(size_t id)
{
    if (Child* child = find(id))
        closeFile(child->work_socket);
}

/// Turn a finished report into a ChildOutcome. Text that is no report was a message.
void ChildProcesses::parseReport(Child& child)
{
    const std::string report = std::move(child.report);
    child.report.clear();
    const auto json = Json::parse(report.substr(1)).value_or(Json());
    const auto number = [&](const char* name)
    { return json.is_object() && json.contains(name) && json[name].is_number(); };
    if (!number("exit") || !number("seconds") || !number("cpu_seconds") || !number("peak_rss_bytes"))
    {
        child.messages += report;
        return;
    }
    ChildOutcome end;
    end.id = child.id;
    end.is_alive = true;
    end.exit_code = json["exit"].get<int>();
    end.messages = std::move(child.messages);
    end.seconds = json["seconds"].get<double>();
    end.cpu_seconds = json["cpu_seconds"].get<double>();
    end.peak_rss_bytes = json["peak_rss_bytes"].get<uint64_t>();
    child.messages.clear();
    outcomes_.push_back(std::move(end));
}

void ChildProcesses::appendOutput(Child& child, std::string_view text)
{
    const auto isInReport = [&] { return !child.report.empty(); };
    while (!text.empty())
    {
        const size_t to = child.is_batch ? text.find(isInReport() ? '\n' : kRecordSeparator) : text.npos;
        const size_t size = std::min(text.size(), isInReport() && to != text.npos ? to + 1 : to);
        std::string& into = isInReport() ? child.report : child.messages;
        into.append(text.substr(0, std::min(size, kMaxMessages - std::min(kMaxMessages, into.size()))));
        text.remove_prefix(size);
        if (to == text.npos)
            return;
        if (isInReport())
            parseReport(child);
        else
        {
            child.report = kRecordSeparator;
            text.remove_prefix(1);
        }
    }
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
            // poll ignores negative descriptors, and would not wait on a pipe that has ended
            closeFile(child.messages_pipe);
            return;
        }
        appendOutput(child, {buffer, static_cast<size_t>(size)});
    }
}

/// Turn the processes that have ended into ChildEnds.
void ChildProcesses::reap()
{
    for (auto child = children_.begin(); child != children_.end();)
    {
        int status = 0;
        rusage usage{};
        if (::wait4(child->process, &status, WNOHANG, &usage) != child->process)
        {
            ++child;
            continue;
        }
        drain(*child);
        ChildOutcome end;
        end.id = child->id;
        end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
        end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
        end.messages = std::move(child->messages);
        end.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - child->start).count();
        end.cpu_seconds = toSeconds(usage.ru_utime) + toSeconds(usage.ru_stime);
        end.peak_rss_bytes = static_cast<uint64_t>(usage.ru_maxrss) * 1024;
        closeFile(child->pidfd);
        closeFile(child->messages_pipe);
        closeFile(child->work_socket);
        child = children_.erase(child);
        outcomes_.push_back(std::move(end));
    }
}

std::optional<ChildOutcome> ChildProcesses::wait(const std::function<void()>& waiting)
{
    for (;;)
    {
        if (outcomes_.empty())
            reap();
        if (!outcomes_.empty())
        {
            ChildOutcome end = std::move(outcomes_.front());
            outcomes_.pop_front();
            return end;
        }
        HEARTH_ASSERT(!children_.empty());

        std::vector<pollfd> files{{signal_file_, POLLIN, 0}};
        for (const Child& child : children_)
        {
            files.push_back({child.pidfd, POLLIN, 0});
            files.push_back({child.messages_pipe, POLLIN, 0});
        }
        ::poll(files.data(), files.size(), kPollInterval_ms);
        if (waiting)
            waiting();
        for (Child& child : children_)
            drain(child);
        signalfd_siginfo signal{};
        if (::read(signal_file_, &signal, sizeof(signal)) == sizeof(signal))
            return std::nullopt;
    }
}

std::optional<std::string> makeBatchLine(std::span<const std::string> arguments)
{
    Json words = Json::array();
    for (const std::string& argument : arguments)
        words.push_back(argument);
    const std::string line = words.dump();
    return Json::parse(line).value_or(Json()) == words ? std::optional(line + "\n") : std::nullopt;
}

std::string programFolder()
{
    std::error_code error;
    return std::filesystem::read_symlink("/proc/self/exe", error).parent_path().string();
}

} // namespace hearth::tools
