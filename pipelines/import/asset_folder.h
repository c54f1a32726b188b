// The folder of an asset: the only place from which its readers may open further files.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/read_list.h"
#include "formats/result.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::import
{

/// The bytes of a regular file of at most `max_bytes`; devices, pipes and folders are refused without being read.
/// errors: input_missing, input_too_large, read_failed.
Result<std::vector<std::byte>> readFile(const std::string& path, uint64_t max_bytes);

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

    /// The content of the file there. errors: those of locate and readFile.
    Result<std::vector<std::byte>> read(std::string_view relative_path, uint64_t max_bytes) const;

private:
    std::string folder_; ///< resolved, ends with '/'
    tools::ReadList* reads_ = nullptr;
};

} // namespace hearth::import
