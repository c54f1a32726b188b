// Families of compressed formats that a target reads, and words of efforts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/blocks/block_texels.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::texels
{

/// Families of formats that a target reads, besides plain ones.
struct Families
{
    bool astc = false;
    bool astc_hdr = false; ///< light, by an extension
    bool etc2 = false;
    bool bc = false;

    friend bool operator==(const Families&, const Families&) = default;
};

/// Return the names of families: "astc", "astc-hdr", "etc2", "bc".
std::vector<std::string> familyNames();

/// Add the family with a name. False if there is none of that name.
bool addFamily(std::string_view name, Families& families);

/// Return the names of the families: "astc, etc2"; "none" without any.
std::string familiesText(const Families& families);

/// Return the names of efforts, "draft", "normal" and "high", in the order of Effort.
std::span<const std::string_view> effortNames();

/// Parse the name of an effort; nullopt if there is none of that name.
std::optional<Effort> parseEffort(std::string_view name);

} // namespace hearth::texels
