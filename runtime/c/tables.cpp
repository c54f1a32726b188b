// Tables of a pack: counts, names and extras.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/tables.h"

#include "runtime/pack/queries/extras_member.h"

#include <array>

using namespace hearth;
using namespace hearth::c;

namespace
{

/// A record of each table, in the order of HEARTH_TABLE_*.
constexpr std::array kRecordNames{"node",  "instance", "mesh",      "material", "image", "camera",
                                  "light", "skin",     "animation", "asset",    "proxy", "joint"};
static_assert(kRecordNames.size() == HEARTH_TABLE_JOINTS + 1);

/// Table of the objects of each kind of extras, in the order of HEARTH_EXTRAS_*.
constexpr std::array kExtrasTables{HEARTH_TABLE_NODES,      HEARTH_TABLE_MESHES, HEARTH_TABLE_MATERIALS,
                                   HEARTH_TABLE_CAMERAS,    HEARTH_TABLE_LIGHTS, HEARTH_TABLE_SKINS,
                                   HEARTH_TABLE_ANIMATIONS, HEARTH_TABLE_ASSETS, HEARTH_TABLE_ASSETS,
                                   HEARTH_TABLE_ASSETS};
static_assert(kExtrasTables.size() == formats::kExtrasOwnerNames.size());
static_assert(HEARTH_EXTRAS_CAMERA == static_cast<int>(formats::ExtrasOwner::camera));
static_assert(HEARTH_EXTRAS_ANIMATION == static_cast<int>(formats::ExtrasOwner::animation));
static_assert(HEARTH_EXTRAS_FILE == static_cast<int>(formats::ExtrasOwner::file));

/// Return `use` of the table's records: a number or a string. `table` is one of HEARTH_TABLE_*.
template <typename Use>
auto withRecords(const formats::PackView& view, uint32_t table, const Use& use)
{
    switch (table)
    {
    case HEARTH_TABLE_NODES:
        return use(view.nodes());
    case HEARTH_TABLE_INSTANCES:
        return use(view.instances());
    case HEARTH_TABLE_MESHES:
        return use(view.meshes());
    case HEARTH_TABLE_MATERIALS:
        return use(view.materials());
    case HEARTH_TABLE_IMAGES:
        return use(view.images());
    case HEARTH_TABLE_CAMERAS:
        return use(view.cameras());
    case HEARTH_TABLE_LIGHTS:
        return use(view.lights());
    case HEARTH_TABLE_SKINS:
        return use(view.skins());
    case HEARTH_TABLE_ANIMATIONS:
        return use(view.animations());
    case HEARTH_TABLE_PROXIES:
        return use(view.proxies());
    case HEARTH_TABLE_JOINTS:
        return use(view.joints());
    default:
        return use(view.assets());
    }
}

template <typename Record>
std::string_view readName(const formats::PackView& view, const Record& record)
{
    return view.text(record.name);
}

std::string_view readName(const formats::PackView& view, const formats::InstanceRecord& instance)
{
    return readName(view, view.nodes()[instance.node]);
}

std::string_view readName(const formats::PackView& view, const formats::ProxyRecord& proxy)
{
    return readName(view, view.meshes()[proxy.mesh]);
}

std::string_view readName(const formats::PackView& view, const formats::JointRecord& joint)
{
    return readName(view, view.nodes()[joint.node]);
}

Status checkTable(const hearth_pack* pack, uint32_t table)
{
    if (pack == nullptr)
        return usage("pack is NULL");
    if (table >= kRecordNames.size())
        return usage("table " + std::to_string(table) + " is not one that this version knows");
    return success();
}

/// owner  HEARTH_EXTRAS_*
Status checkOwner(uint32_t owner)
{
    if (owner >= kExtrasTables.size())
        return usage("owner " + std::to_string(owner) + " is not one that this version knows");
    return success();
}

/// "the pack has no node called door, from node 4 on".
std::string missingText(std::string_view kind, std::string_view relation, std::string_view name,
                        uint32_t first)
{
    std::string text = "the pack has no " + std::string(kind) + " " + std::string(relation) + " ";
    text += name.empty() ? "\"\"" : name;
    return first == 0 ? text : text + ", from " + std::string(kind) + " " + std::to_string(first) + " on";
}

uint32_t readCount(const hearth_pack& pack, uint32_t table)
{
    return withRecords(pack.pack.view(), table,
                       [](const auto& records) { return static_cast<uint32_t>(records.size()); });
}

std::string_view readName(const hearth_pack& pack, uint32_t table, uint32_t index)
{
    const formats::PackView& view = pack.pack.view();
    return withRecords(view, table, [&](const auto& records) { return readName(view, records[index]); });
}

} // namespace

Status hearth::c::checkRecord(const hearth_pack* pack, uint32_t table, uint32_t index)
{
    HEARTH_TRY(checkTable(pack, table));
    if (const uint32_t count = readCount(*pack, table); index >= count)
        return usage("there is no " + std::string(kRecordNames[table]) + " " + std::to_string(index) +
                     ": the pack has " + std::to_string(count));
    return success();
}

hearth_result hearth_pack_get_count(const hearth_pack* pack, uint32_t table, uint32_t* count, char* message,
                                    size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkTable(pack, table));
                    if (count == nullptr)
                        return usage("count is NULL");
                    *count = readCount(*pack, table);
                    return success();
                });
}

hearth_result hearth_pack_get_name(const hearth_pack* pack, uint32_t table, uint32_t index, hearth_name* name,
                                   char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkRecord(pack, table, index));
                    if (name == nullptr)
                        return usage("name is NULL");
                    const std::string_view text = readName(*pack, table, index);
                    *name = {text.empty() ? "" : text.data(), text.size()};
                    return success();
                });
}

hearth_result hearth_pack_find_record(const hearth_pack* pack, uint32_t table, const char* name,
                                      uint32_t first, uint32_t* index, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkTable(pack, table));
                    if (name == nullptr || index == nullptr)
                        return usage("name or index is NULL");
                    const std::string_view wanted(name);
                    const uint32_t count = readCount(*pack, table);
                    for (uint32_t i = first; i < count; ++i)
                        if (readName(*pack, table, i) == wanted)
                        {
                            *index = i;
                            return success();
                        }
                    return usage(missingText(kRecordNames[table], "called", wanted, first));
                });
}

hearth_result hearth_pack_find_extra(const hearth_pack* pack, uint32_t owner, const char* name,
                                     uint32_t first, uint32_t* index, hearth_extras* value, char* message,
                                     size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkOwner(owner));
                    HEARTH_TRY(checkTable(pack, kExtrasTables[owner]));
                    if (name == nullptr || index == nullptr)
                        return usage("name or index is NULL");
                    const formats::PackView& view = pack->pack.view();
                    for (const formats::ExtrasRecord& record : view.extras())
                    {
                        if (record.owner != owner || record.index < first)
                            continue;
                        const std::string_view found = pack::findMember(view.text(record.json), name);
                        if (found.empty())
                            continue;
                        *index = record.index;
                        if (value != nullptr)
                            *value = {found.data(), found.size()};
                        return success();
                    }
                    return usage(
                        missingText(formats::kExtrasOwnerNames[owner], "with the extra", name, first));
                });
}

hearth_result hearth_pack_get_extras(const hearth_pack* pack, uint32_t owner, uint32_t index,
                                     hearth_extras* extras, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkOwner(owner));
                    HEARTH_TRY(checkRecord(pack, kExtrasTables[owner], index));
                    if (extras == nullptr)
                        return usage("extras is NULL");
                    const std::string_view json =
                        pack->pack.view().findExtras(static_cast<formats::ExtrasOwner>(owner), index);
                    *extras = {json.empty() ? nullptr : json.data(), json.size()};
                    return success();
                });
}
