// Lists what a pack has and a glTF file does not say, so that nothing is lost silently.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <map>
#include <string>
#include <vector>

namespace hearth::gltf_export
{

/// Kinds of things that are left out or changed, each with its count.
class Omissions
{
public:
    /// kind  "light probes", "texture transforms with shear: their nearest rotation and scale are
    /// written"
    void add(const std::string& kind, size_t count = 1) { counts_[kind] += count; }

    /// Return a line for each kind that has a count, in the order of the alphabet: "light probes: 3".
    std::vector<std::string> lines() const;

private:
    std::map<std::string, size_t> counts_;
};

/// Add what glTF has no words for, of the whole pack.
/// has_lods  coarser levels are written
void addPackOmissions(const formats::PackView& pack, bool has_lods, Omissions& omissions);

} // namespace hearth::gltf_export
