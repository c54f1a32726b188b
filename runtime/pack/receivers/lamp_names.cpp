// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/receivers/lamp_names.h"

#include "formats/base/index.h"

#include <algorithm>

namespace hearth::pack
{

namespace
{

/// Names of an error, at most: scenes may have thousands of lights.
constexpr size_t kMaxNames = 12;

/// Name the lamps that there are.
std::string describeLamps(const std::vector<NamedLamp>& lamps)
{
    std::vector<std::string_view> names;
    for (const NamedLamp& lamp : lamps)
        if (!lamp.name.empty() && std::find(names.begin(), names.end(), lamp.name) == names.end())
            names.push_back(lamp.name);
    if (names.empty())
        return lamps.empty() ? "the pack has no lights" : "the pack's lights have no names";
    std::string text = "there are: ";
    for (size_t i = 0; i < std::min(names.size(), kMaxNames); ++i)
        text += (i > 0 ? ", " : "") + std::string(names[i]);
    return names.size() > kMaxNames ? text + " and " + std::to_string(names.size() - kMaxNames) + " more"
                                    : text;
}

} // namespace

std::vector<NamedLamp> listLamps(const formats::PackView& pack)
{
    std::vector<NamedLamp> lamps;
    for (uint32_t i = 0; i < pack.lights().size(); ++i)
        lamps.push_back({pack.text(pack.lights()[i].name), formats::ReceiverLampKind::light, i});
    for (const formats::ReceiverLampRecord& lamp : pack.receivers().lamps)
        if (lamp.kind == static_cast<uint32_t>(formats::ReceiverLampKind::mesh_light))
        {
            const uint32_t node = pack.instances()[lamp.index].node;
            lamps.push_back({node == kInvalidIndex ? std::string_view() : pack.text(pack.nodes()[node].name),
                             formats::ReceiverLampKind::mesh_light, lamp.index});
        }
    return lamps;
}

Result<std::vector<NamedLamp>> findLamps(const formats::PackView& pack, std::string_view name)
{
    std::vector<NamedLamp> lamps = listLamps(pack);
    const std::string known = describeLamps(lamps);
    std::erase_if(lamps, [&](const NamedLamp& lamp) { return name.empty() || lamp.name != name; });
    if (lamps.empty())
        return Error{Issue::usage, pack.name(), "light \"" + std::string(name) + "\"", "is none; " + known};
    return lamps;
}

} // namespace hearth::pack
