// Cache of file hashes: a file whose metadata is unchanged is not read again.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace hearth::graph
{

/// Hashes files and remembers the hashes. A remembered hash is valid while device, inode, size and the times
/// of content and status (mtime, ctime, in nanoseconds) are unchanged. A program cannot set the status time
/// back, and a hash is not remembered before the file is two seconds old: an edit within one tick of the file
/// system's clock, at most one second on file systems in use, cannot go unnoticed.
class FileHashes
{
public:
    /// folder  base of relative paths
    explicit FileHashes(const std::string& folder) : folder_(folder + "/") {}

    /// Load the file that save() wrote; an unreadable or damaged file counts as empty.
    void load(const std::string& path);
    /// Save the hashes that were asked for since load(), and no others. Errors cost only time. An unchanged
    /// file is not written again.
    void save(const std::string& path) const;

    /// Return the SHA-256 of the content; nullopt where there is no readable regular file. A file is read
    /// once: a cook sees one state of each file. Not thread-safe.
    std::optional<std::string> hashFile(const std::string& path);

    /// Number of files that had to be read.
    size_t filesRead() const { return files_read_; }

private:
    struct KnownHash
    {
        std::string metadata; ///< metadata of the file, as text
        std::string hash;
    };
    std::map<std::string, KnownHash> remembered_; ///< by absolute path
    /// hashes asked for since load(), by absolute path; empty `metadata`: not to be saved
    std::map<std::string, KnownHash> current_;
    std::map<std::string, std::optional<std::string>> hash_of_path_;
    std::string folder_;
    std::string loaded_text_;
    size_t files_read_ = 0;
};

} // namespace hearth::graph
