// Tables of a pack: counts, names, extras, instances and cameras.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/handles.h"

#include <algorithm>
#include <array>

using namespace hearth;
using namespace hearth::c;

namespace
{

/// A record of each table, in the order of HEARTH_TABLE_*.
constexpr std::array kRecordNames{"node",   "instance", "mesh", "material",  "image",
                                  "camera", "light",    "skin", "animation", "asset"};
static_assert(kRecordNames.size() == HEARTH_TABLE_ASSETS + 1);

/// Table of the objects of each kind of extras, in the order of HEARTH_EXTRAS_*.
constexpr std::array kExtrasTables{HEARTH_TABLE_NODES,      HEARTH_TABLE_MESHES, HEARTH_TABLE_MATERIALS,
                                   HEARTH_TABLE_CAMERAS,    HEARTH_TABLE_LIGHTS, HEARTH_TABLE_SKINS,
                                   HEARTH_TABLE_ANIMATIONS, HEARTH_TABLE_ASSETS, HEARTH_TABLE_ASSETS,
                                   HEARTH_TABLE_ASSETS};
static_assert(kExtrasTables.size() == formats::kExtrasOwnerNames.size());
static_assert(HEARTH_EXTRAS_CAMERA == static_cast<int>(formats::ExtrasOwner::camera));
static_assert(HEARTH_EXTRAS_ANIMATION == static_cast<int>(formats::ExtrasOwner::animation));
static_assert(HEARTH_EXTRAS_FILE == static_cast<int>(formats::ExtrasOwner::file));

static_assert(HEARTH_CAMERA_PERSPECTIVE == static_cast<int>(formats::CameraType::perspective));
static_assert(HEARTH_CAMERA_ORTHOGRAPHIC == static_cast<int>(formats::CameraType::orthographic));

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

Status checkTable(const hearth_pack* pack, uint32_t table)
{
    if (pack == nullptr)
        return usage("pack is NULL");
    if (table >= kRecordNames.size())
        return usage("table " + std::to_string(table) + " is not one that this version knows");
    return success();
}

uint32_t readCount(const hearth_pack& pack, uint32_t table)
{
    return withRecords(pack.pack.view(), table,
                       [](const auto& records) { return static_cast<uint32_t>(records.size()); });
}

/// Check that the pack is not NULL and has the record. `table` is one of HEARTH_TABLE_*.
Status checkRecord(const hearth_pack* pack, uint32_t table, uint32_t index)
{
    HEARTH_TRY(checkTable(pack, table));
    if (const uint32_t count = readCount(*pack, table); index >= count)
        return usage("there is no " + std::string(kRecordNames[table]) + " " + std::to_string(index) +
                     ": the pack has " + std::to_string(count));
    return success();
}

void copyRows(const Affine3& from, float (&to)[3][4])
{
    static_assert(sizeof(from.m) == sizeof(to));
    std::copy_n(&from.m[0][0], 12, &to[0][0]);
}

void copyVector(Float3 from, float (&to)[3])
{
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

/// Convert to the camera of a frame, as hearth-render draws --scene-camera.
hearth_camera makeCamera(const formats::CameraRecord& record)
{
    const Affine3& world_from_camera = record.world_from_camera;
    const Float3 position = transformPoint(world_from_camera, {});
    hearth_camera view{};
    copyVector(position, view.position);
    copyVector(position + transformVector(world_from_camera, {0, 0, -1}), view.target);
    copyVector(transformVector(world_from_camera, {0, 1, 0}), view.up);
    view.y_fov_rad = record.y_fov_rad;
    view.z_near = record.z_near;
    return view;
}

hearth_pack_camera toC(const formats::CameraRecord& record)
{
    hearth_pack_camera camera = HEARTH_PACK_CAMERA_INIT;
    camera.type = record.type;
    camera.node = record.node;
    camera.aspect = record.aspect;
    camera.half_width = record.x_magnification;
    camera.half_height = record.y_magnification;
    camera.z_far = record.z_far;
    copyRows(record.world_from_camera, camera.world_from_camera);
    camera.view = makeCamera(record);
    return camera;
}

} // namespace

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
                    const formats::PackView& view = pack->pack.view();
                    const std::string_view text = withRecords(
                        view, table, [&](const auto& records) { return readName(view, records[index]); });
                    *name = {text.empty() ? "" : text.data(), text.size()};
                    return success();
                });
}

hearth_result hearth_pack_get_extras(const hearth_pack* pack, uint32_t owner, uint32_t index,
                                     hearth_extras* extras, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (owner >= kExtrasTables.size())
                        return usage("owner " + std::to_string(owner) +
                                     " is not one that this version knows");
                    HEARTH_TRY(checkRecord(pack, kExtrasTables[owner], index));
                    if (extras == nullptr)
                        return usage("extras is NULL");
                    const std::string_view json =
                        pack->pack.view().findExtras(static_cast<formats::ExtrasOwner>(owner), index);
                    *extras = {json.empty() ? nullptr : json.data(), json.size()};
                    return success();
                });
}

hearth_result hearth_pack_get_instance(const hearth_pack* pack, uint32_t index,
                                       hearth_pack_instance* instance, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkRecord(pack, HEARTH_TABLE_INSTANCES, index));
                    HEARTH_TRY(checkStruct("instance", instance));
                    const formats::InstanceRecord& record = pack->pack.view().instances()[index];
                    instance->mesh = record.mesh;
                    instance->node = record.node;
                    instance->reserved = 0;
                    copyRows(record.world_from_object, instance->world_from_object);
                    return success();
                });
}

hearth_result hearth_pack_get_camera(const hearth_pack* pack, uint32_t index, hearth_pack_camera* camera,
                                     char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkRecord(pack, HEARTH_TABLE_CAMERAS, index));
                    HEARTH_TRY(checkStruct("camera", camera));
                    *camera = toC(pack->pack.view().cameras()[index]);
                    return success();
                });
}
