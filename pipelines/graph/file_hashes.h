// Hashes of the user's files, remembered as long as the files look untouched.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace hearth::graph
{

/// A file's hash is believed again where its device, inode, size and times of content and of status (mtime, ctime, in
/// nanoseconds) are as before. The status time cannot be set back by a program, and a file is not remembered before it is
/// two seconds old: an edit in the same tick of its clock, one second at most on file systems in use, cannot hide.
class FileHashes
{
public:
    /// folder  that relative paths start from
    explicit FileHashes(const std::string& folder) : folder_(folder + "/") {}

    /// Take what save() wrote; a file that cannot be read or is damaged says nothing.
    void load(const std::string& path);
    /// Write what has been asked for since, and nothing else; errors do no harm but time. Nothing is written where it would
    /// say what load() read.
    void save(const std::string& path) const;

    /// SHA-256 of the content; nullopt where there is no regular file that can be read. Asked twice, it reads once: a cook
    /// sees one state of each file. Not for several threads.
    std::optional<std::string> hashOf(const std::string& path);

    /// Files that had to be read.
    size_t filesRead() const { return files_read_; }

private:
    struct Known
    {
        std::string looks; ///< what a file looks like from outside, as text
        std::string hash;
    };
    std::map<std::string, Known> remembered_; ///< by absolute path
    std::map<std::string, Known> seen_;       ///< since, by absolute path; no looks: not to be remembered
    std::map<std::string, std::optional<std::string>> hash_of_path_;
    std::string folder_;
    std::string loaded_text_;
    size_t files_read_ = 0;
};

} // namespace hearth::graph
