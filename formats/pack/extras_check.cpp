// Checks the extras of objects. That their texts are JSON is checked by pipelines/verify.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/check_tools.h"

namespace hearth::formats::check
{

namespace
{

/// Return the number of objects of a kind; nullopt if there is no such kind.
std::optional<size_t> countOwners(const PackView& view, uint32_t owner)
{
    switch (static_cast<ExtrasOwner>(owner))
    {
    case ExtrasOwner::node:
        return view.nodes().size();
    case ExtrasOwner::mesh:
        return view.meshes().size();
    case ExtrasOwner::material:
        return view.materials().size();
    case ExtrasOwner::camera:
        return view.cameras().size();
    case ExtrasOwner::light:
        return view.lights().size();
    case ExtrasOwner::skin:
        return view.skins().size();
    case ExtrasOwner::animation:
        return view.animations().size();
    case ExtrasOwner::asset:
    case ExtrasOwner::scene:
    case ExtrasOwner::file:
        return view.assets().size();
    }
    return std::nullopt;
}

} // namespace

Status checkExtras(const PackView& view)
{
    constexpr const char* kKind = "extras";
    for (size_t i = 0; i < view.extras().size(); ++i)
    {
        const ExtrasRecord& record = view.extras()[i];
        const std::optional<size_t> count = countOwners(view, record.owner);
        if (!count)
            return makeError(view, Issue::meaning_value, kKind, i, "owner " + std::to_string(record.owner));
        if (record.index >= *count)
            return makeError(view, Issue::meaning_reference, kKind, i,
                             std::string(kExtrasOwnerNames[record.owner]) + " " +
                                 std::to_string(record.index) + " of " + std::to_string(*count));
        if (record.json.length == 0 || record.json.length > kMaxExtrasBytes)
            return makeError(view, Issue::meaning_value, kKind, i,
                             std::to_string(record.json.length) + " bytes of JSON");
        if (i > 0 && makeExtrasKey(record.owner, record.index) <=
                         makeExtrasKey(view.extras()[i - 1].owner, view.extras()[i - 1].index))
            return makeError(view, Issue::meaning_order, kKind, i, "its object does not follow the last one");
    }
    return success();
}

} // namespace hearth::formats::check
