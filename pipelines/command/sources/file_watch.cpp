// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/sources/file_watch.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/signalfd.h>
#include <unistd.h>
#include <utility>

namespace hearth::command
{

namespace
{

namespace fs = std::filesystem;

constexpr int kQuietPeriod_ms = 100;
constexpr uint32_t kAppearanceEvents = IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO;
constexpr uint32_t kWatchedEvents =
    kAppearanceEvents | IN_CLOSE_WRITE | IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR;

Error cannotWatch(const std::string& path)
{
    return {Issue::read_failed, path, "", std::string("cannot be watched: ") + std::strerror(errno)};
}

/// SIGINT, SIGTERM and SIGHUP as a file descriptor, while the object lives.
class SignalDescriptor
{
public:
    SignalDescriptor()
    {
        sigset_t signals;
        ::sigemptyset(&signals);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP})
            ::sigaddset(&signals, signal);
        ::sigprocmask(SIG_BLOCK, &signals, &before_);
        file_ = ::signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
        HEARTH_ASSERT(file_ >= 0);
    }
    ~SignalDescriptor()
    {
        ::close(file_);
        ::sigprocmask(SIG_SETMASK, &before_, nullptr);
    }
    SignalDescriptor(const SignalDescriptor&) = delete;
    SignalDescriptor& operator=(const SignalDescriptor&) = delete;

    int file() const { return file_; }
    bool isPending() const
    {
        signalfd_siginfo signal{};
        return ::read(file_, &signal, sizeof(signal)) == sizeof(signal);
    }

private:
    sigset_t before_;
    int file_ = -1;
};

} // namespace

Result<FileWatch> FileWatch::create()
{
    const int events = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    if (events < 0)
        return cannotWatch("inotify");
    return FileWatch(events);
}

FileWatch::FileWatch(FileWatch&& other) noexcept
    : events_(std::exchange(other.events_, -1)),
      paths_(std::move(other.paths_)),
      watch_of_folder_(std::move(other.watch_of_folder_)),
      names_(std::move(other.names_)),
      folder_of_watch_(std::move(other.folder_of_watch_)),
      earlier_change_(std::move(other.earlier_change_))
{
}

FileWatch::~FileWatch()
{
    if (events_ >= 0)
        ::close(events_);
}

namespace
{

using Change = FileWatch::Change;

/// Choose which of two changes to report: the first, but a watched file before other files of a folder.
std::optional<Change> preferredChange(std::optional<Change> first, std::optional<Change> second)
{
    return !first || (second && first->is_in_folder && !second->is_in_folder) ? std::move(second)
                                                                              : std::move(first);
}

} // namespace

/// Watch the folder of a path.
/// before  watches of folders until now
Status FileWatch::add(const fs::path& path, const std::map<std::string, int>& before,
                      fs::file_time_type since)
{
    std::error_code error;
    fs::path name = path;
    fs::path folder = path.parent_path();
    while (!fs::is_directory(folder, error) && folder.has_relative_path())
    {
        name = folder;
        folder = folder.parent_path();
    }
    const auto known = before.find(folder.string());
    const int watch = ::inotify_add_watch(events_, folder.c_str(), kWatchedEvents);
    if (watch < 0)
        return cannotWatch(folder.string());
    watch_of_folder_[folder.string()] = watch;
    names_[watch][name.filename().string()] = path.string();
    const auto written = fs::last_write_time(path, error);
    if ((known == before.end() || known->second != watch) && !error && written >= since)
        earlier_change_ = preferredChange(earlier_change_, Change{path.string()});
    return success();
}

Status FileWatch::watch(const std::vector<std::string>& paths, fs::file_time_type since,
                        const std::vector<std::string>& folders)
{
    earlier_change_ = readEvents();
    const std::map<std::string, int> before = std::exchange(watch_of_folder_, {});
    names_.clear();
    paths_.clear();
    folder_of_watch_.clear();
    for (const std::string& path : paths)
    {
        std::error_code error;
        const fs::path absolute = fs::absolute(path, error).lexically_normal();
        if (!paths_.insert(absolute.string()).second)
            continue;
        HEARTH_TRY(add(absolute, before, since));
        // behind a symbolic link the file itself lies elsewhere
        if (const fs::path real = fs::canonical(absolute, error); !error && real != absolute)
            HEARTH_TRY(add(real, before, since));
    }
    for (const std::string& folder : folders)
    {
        // watched like a file in it: if the folder is absent, its creation is waited for
        std::error_code error;
        const fs::path absolute = fs::absolute(folder, error).lexically_normal() / "";
        HEARTH_TRY(add(absolute, before, fs::file_time_type::max()));
        if (const auto watched = watch_of_folder_.find(absolute.parent_path().string());
            watched != watch_of_folder_.end())
            folder_of_watch_[watched->second] = folder;
    }
    for (const auto& [folder, watch] : before)
        if (!names_.contains(watch))
            ::inotify_rm_watch(events_, watch);
    return success();
}

/// Read all pending events. Return the change to report; nullopt if no event concerns the watched files and
/// folders.
std::optional<FileWatch::Change> FileWatch::readEvents()
{
    std::optional<Change> changed;
    alignas(inotify_event) std::array<char, 16384> buffer;
    for (;;)
    {
        const ssize_t size = ::read(events_, buffer.data(), buffer.size());
        if (size <= 0)
            return changed;
        for (ssize_t at = 0; at < size;)
        {
            const auto* event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
            at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
            const auto names = names_.find(event->wd);
            if ((event->mask & IN_Q_OVERFLOW) != 0)
                changed = preferredChange(changed, Change{"too many changes to name one"});
            if (names == names_.end())
                continue;
            const auto name = names->second.find(event->len > 0 ? event->name : "");
            if (name != names->second.end())
                changed = preferredChange(changed, Change{name->second});
            else if ((event->mask & (IN_DELETE_SELF | IN_MOVE_SELF)) != 0)
                changed = preferredChange(changed, Change{names->second.begin()->second});
            else if (const auto folder = folder_of_watch_.find(event->wd);
                     folder != folder_of_watch_.end() && (event->mask & kAppearanceEvents) != 0)
                changed = preferredChange(changed, Change{folder->second, true});
        }
    }
}

std::optional<FileWatch::Change> FileWatch::wait()
{
    const SignalDescriptor signals;
    std::optional<Change> changed = std::exchange(earlier_change_, std::nullopt);
    for (;;)
    {
        std::array<pollfd, 2> files{{{signals.file(), POLLIN, 0}, {events_, POLLIN, 0}}};
        const int ready = ::poll(files.data(), files.size(), changed ? kQuietPeriod_ms : -1);
        if (signals.isPending())
            return std::nullopt;
        if (ready == 0)
            return changed;
        changed = preferredChange(changed, readEvents());
    }
}

} // namespace hearth::command
