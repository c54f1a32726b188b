// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/check_tools.h"

namespace hearth::formats::check
{

namespace
{

constexpr const char* kKind = "specular table";

/// True if a wider cone never lets through less.
bool isMonotoneInAperture(const SpecularTableRecord& table)
{
    for (uint32_t i = 0; i < kSpecularTexels; ++i)
        if (i % shared::kSpecularNodes != 0 && table.values[i] < table.values[i - 1])
            return false;
    return true;
}

Status checkTable(const PackView& view, size_t i)
{
    const SpecularTableRecord& table = view.specularTables()[i];
    constexpr uint32_t kNodes = shared::kSpecularNodes;
    if (table.aperture_nodes != kNodes || table.roughness_nodes != kNodes || table.beta_nodes != kNodes)
        return makeError(view, Issue::meaning_value, kKind, i, "it is not of 16 x 16 x 16 nodes");
    if (table.spacing > static_cast<uint32_t>(SpecularSpacing::half_sine))
        return makeError(view, Issue::meaning_value, kKind, i, "spacing " + std::to_string(table.spacing));
    if (table.masking > static_cast<uint32_t>(SpecularMasking::correlated))
        return makeError(view, Issue::meaning_value, kKind, i, "masking " + std::to_string(table.masking));
    if (!inside(table.normal_lambda, 0, 1) || table.min_roughness != shared::kMinSpecularRoughness)
        return makeError(view, Issue::meaning_value, kKind, i,
                         "its assumed normal or its roughness is not possible");
    if (table.reserved != 0)
        return makeError(view, Issue::meaning_padding, kKind, i, "a reserved field is not 0");
    if (!isMonotoneInAperture(table))
        return makeError(view, Issue::meaning_monotone, kKind, i, "a value falls while the aperture grows");
    return success();
}

} // namespace

Status checkSpecularTable(const PackView& view)
{
    if (view.specularTables().size() > 1)
        return makeError(view, Issue::meaning_value, kKind, 1, "a pack has one at most");
    return view.specularTables().empty() ? success() : checkTable(view, 0);
}

} // namespace hearth::formats::check
