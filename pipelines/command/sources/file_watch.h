// Waits for changes of files, by inotify on the folders that they lie in.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace hearth::command
{

/// Folders are watched, not files: an editor that saves puts another file in the place of the old one, and a file that
/// is not there yet can be waited for. Where its folder is not there either, the nearest above that is.
class FileWatch
{
public:
    /// errors: read_failed, where the system has no more watches to give
    static Result<FileWatch> create();
    ~FileWatch();
    FileWatch(FileWatch&& other) noexcept;
    FileWatch& operator=(FileWatch&&) = delete;

    /// Watch these files from now on. What has changed in folders watched before is not missed; of folders that are new,
    /// a file that was written after `since` counts as changed.
    /// folders    in which any file that comes or goes is a change; what happened there before is not looked for
    /// errors: read_failed
    Status watch(const std::vector<std::string>& paths, std::filesystem::file_time_type since,
                 const std::vector<std::string>& folders = {});

    size_t size() const { return paths_.size(); }

    struct Change
    {
        std::string path; ///< of the first file that has changed
        /// No file that is watched has changed, but one has come or gone in this folder.
        bool is_of_folder = false;
    };

    /// Wait until one of them changes, comes or goes, and then until nothing has for a tenth of a second: who saves
    /// several files is not interrupted.
    /// returns    nullopt where SIGINT, SIGTERM or SIGHUP came instead
    std::optional<Change> wait();

private:
    explicit FileWatch(int events) : events_(events) {}
    Status add(const std::filesystem::path& path, const std::map<std::string, int>& before,
               std::filesystem::file_time_type since);
    std::optional<Change> takeEvents();

    int events_ = -1;
    std::set<std::string> paths_;
    std::map<std::string, int> watch_of_folder_;
    /// By watch: name in its folder, and the path that it belongs to.
    std::map<int, std::map<std::string, std::string>> names_;
    std::map<int, std::string> folder_of_watch_; ///< where any file counts
    std::optional<Change> changed_before_;       ///< while nobody waited
};

} // namespace hearth::command
