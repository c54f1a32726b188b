// Tables of a pack: counts, names, extras, instances, cameras and proxies.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/handles.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

using namespace hearth;
using namespace hearth::c;

namespace
{

/// A record of each table, in the order of HEARTH_TABLE_*.
constexpr std::array kRecordNames{"node",  "instance", "mesh",      "material", "image", "camera",
                                  "light", "skin",     "animation", "asset",    "proxy"};
static_assert(kRecordNames.size() == HEARTH_TABLE_PROXIES + 1);

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

static_assert(HEARTH_PROXY_CLEANED == static_cast<int>(formats::ProxyOrigin::cleaned));
static_assert(HEARTH_PROXY_WRAPPED == static_cast<int>(formats::ProxyOrigin::wrapped));
static_assert(HEARTH_PROXY_AUTHORED == static_cast<int>(formats::ProxyOrigin::authored));
// the caller gets records as they lie in the pack
static_assert(sizeof(hearth_proxy_section) == sizeof(formats::ProxySectionRecord));
static_assert(offsetof(hearth_proxy_section, material) == offsetof(formats::ProxySectionRecord, material));
static_assert(offsetof(hearth_proxy_section, is_convex) == offsetof(formats::ProxySectionRecord, is_convex));
static_assert(sizeof(hearth_proxy_binding) == sizeof(formats::ProxyBindingRecord));
static_assert(offsetof(hearth_proxy_binding, weights) == offsetof(formats::ProxyBindingRecord, weights));
static_assert(offsetof(hearth_proxy_binding, distance) == offsetof(formats::ProxyBindingRecord, distance));
static_assert(sizeof(Float3) == 3 * sizeof(float));

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

/// Return the records of a range, as C sees them; null for an empty one.
template <typename To, typename From>
const To* readRange(std::span<const From> table, formats::Range range)
{
    return range.count == 0 ? nullptr : reinterpret_cast<const To*>(&table[range.first]);
}

hearth_proxy toC(const formats::PackView& view, const formats::ProxyRecord& record)
{
    hearth_proxy proxy = HEARTH_PROXY_INIT;
    proxy.mesh = record.mesh;
    proxy.origin = record.origin;
    proxy.is_closed = record.is_closed;
    proxy.distance = record.distance;
    proxy.mesh_distance = record.mesh_distance;
    proxy.position_count = record.positions.count;
    proxy.index_count = record.indices.count;
    proxy.section_count = record.sections.count;
    proxy.binding_count = record.bindings.count;
    proxy.positions = readRange<float>(view.proxyPositions(), record.positions);
    proxy.indices = readRange<uint32_t>(view.proxyIndices(), record.indices);
    proxy.sections = readRange<hearth_proxy_section>(view.proxySections(), record.sections);
    proxy.bindings = readRange<hearth_proxy_binding>(view.proxyBindings(), record.bindings);
    return proxy;
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

hearth_result hearth_pack_get_proxy(const hearth_pack* pack, uint32_t index, hearth_proxy* proxy,
                                    char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkRecord(pack, HEARTH_TABLE_PROXIES, index));
                    HEARTH_TRY(checkStruct("proxy", proxy));
                    const formats::PackView& view = pack->pack.view();
                    *proxy = toC(view, view.proxies()[index]);
                    return success();
                });
}
