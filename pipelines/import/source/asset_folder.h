// The folder of an asset: the only place from which its readers may open further files.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/read_list.h"
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

    /// The name of the asset's file, without its folder.
    const std::string& assetName() const { return asset_name_; }

    /// "; nearest: ..." to stand behind the message of a failed read(): the file that the path probably
    /// means. Empty where none is near, and where something else is wrong with the file. The folder is listed
    /// for it, which is nothing that results are kept by: it may stand on stderr, but in no part.
    std::string suggestionFor(std::string_view relative_path, Issue issue) const;

private:
    std::string folder_; ///< resolved, ends with '/'
    std::string asset_name_;
    tools::ReadList* reads_ = nullptr;
    mutable std::optional<FileNames> names_; ///< listed when first asked for
};

} // namespace hearth::import
