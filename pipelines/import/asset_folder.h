// The folder of an asset: the only place from which its readers may open further files.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/read_list.h"
#include "formats/result.h"
#include "pipelines/import/file_bytes.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::import
{

/// Note what was read under that path.
void noteRead(tools::ReadList& reads, const std::string& path, const FileBytes& file);

class AssetFolder
{
public:
    /// The folder that holds the file `asset_path`, which exists.
    /// reads  notes every file that is read or looked for in vain; null: nobody asks
    AssetFolder(const std::string& asset_path, tools::ReadList* reads);

    /// Where the relative path (plain text, nothing percent-encoded) leads, symbolic links resolved.
    /// errors: uri_malformed (empty, control characters), uri_outside (absolute, a drive or scheme, "..", a link that
    /// leads out), input_missing (nothing there, or not a regular file).
    Result<std::string> locate(std::string_view relative_path) const;

    /// The content of the file there. errors: those of locate and FileBytes::read.
    Result<FileBytes> read(std::string_view relative_path, uint64_t max_bytes) const;

private:
    std::string folder_; ///< resolved, ends with '/'
    tools::ReadList* reads_ = nullptr;
};

} // namespace hearth::import
