// Waits for changes of files, with inotify on their folders.
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

/// Watch of files through their folders: an editor saves by replacing a file, and a file that does not exist
/// yet can be waited for. If its folder does not exist either, the nearest existing folder above is watched.
class FileWatch
{
public:
    /// errors: read_failed if the system has no more watches
    static Result<FileWatch> create();
    ~FileWatch();
    FileWatch(FileWatch&& other) noexcept;
    FileWatch& operator=(FileWatch&&) = delete;

    /// Watch these files from now on. Changes in folders that were watched before are not missed. In new
    /// folders, a file that was written at `since` or later counts as changed.
    /// folders    folders in which any file that appears or vanishes is a change; earlier changes there are
    ///            ignored
    /// errors: read_failed
    Status watch(const std::vector<std::string>& paths, std::filesystem::file_time_type since,
                 const std::vector<std::string>& folders = {});

    size_t size() const { return paths_.size(); }

    struct Change
    {
        std::string path; ///< first changed file, or the folder
        /// No watched file has changed, but a file has appeared or vanished in this folder.
        bool is_in_folder = false;
    };

    /// Wait until one of them changes, appears or vanishes, and then until nothing has changed for a tenth of
    /// a second: saving several files is one change.
    /// returns    nullopt after SIGINT, SIGTERM or SIGHUP
    std::optional<Change> wait();

private:
    explicit FileWatch(int events) : events_(events) {}
    Status add(const std::filesystem::path& path, const std::map<std::string, int>& before,
               std::filesystem::file_time_type since);
    std::optional<Change> readEvents();

    int events_ = -1;
    std::set<std::string> paths_;
    std::map<std::string, int> watch_of_folder_;
    /// By watch: name in its folder, and the watched path that it belongs to.
    std::map<int, std::map<std::string, std::string>> names_;
    std::map<int, std::string> folder_of_watch_; ///< folders in which any file counts
    std::optional<Change> earlier_change_;       ///< change that happened before wait()
};

} // namespace hearth::command
