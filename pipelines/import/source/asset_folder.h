// Folder of an asset: the only folder from which its readers may open further files.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/dependency_list.h"
#include "formats/base/result.h"
#include "pipelines/import/source/file_bytes.h"
#include "pipelines/import/source/nearest_file.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::import
{

/// Record in `reads` that `path` was read, with the content of `file`.
void recordRead(tools::DependencyList& reads, const std::string& path, const FileBytes& file);

class AssetFolder
{
public:
    /// Open the folder of the file `asset_path`, which exists.
    /// reads  records every file that is read or found missing; null: not recorded
    AssetFolder(const std::string& asset_path, tools::DependencyList* reads);

    /// Resolve a relative path (plain text, not percent-encoded) and its symbolic links.
    /// errors: uri_malformed (empty, control characters), uri_outside (absolute, a drive or scheme, "..", a
    /// link that leads out), input_missing (no such file, or not a regular file).
    Result<std::string> locate(std::string_view relative_path) const;

    /// Read the file at a relative path. errors: those of locate and FileBytes::read.
    Result<FileBytes> read(std::string_view relative_path, uint64_t max_bytes) const;

    /// File name of the asset, without its folder.
    const std::string& assetName() const { return asset_name_; }

    /// Return "; nearest: ...", to append to the message of a failed read(): the file that the path probably
    /// means. Empty if no file is near, and if the failure has another cause. The suggestion may go to
    /// stderr, but into no part: it depends on a folder listing, which is not an input of the cached results.
    std::string suggestNearest(std::string_view relative_path, Issue issue) const;

private:
    std::string folder_; ///< resolved, ends with '/'
    std::string asset_name_;
    tools::DependencyList* reads_ = nullptr;
    mutable std::optional<FileListing> names_; ///< listed on first use
};

} // namespace hearth::import
