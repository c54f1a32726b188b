// Records of a pack's tables: nodes, instances, meshes, skins, joints, lights, cameras and proxies.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/tables.h"

#include "runtime/pack/queries/rest_transforms.h"

#include <algorithm>
#include <cstddef>
#include <span>

using namespace hearth;
using namespace hearth::c;

namespace
{

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

hearth_transform toC(const Affine3d& from)
{
    hearth_transform to;
    static_assert(sizeof(to) == sizeof(from.m));
    std::copy_n(&from.m[0][0], 12, &to.m[0][0]);
    return to;
}

hearth_pack_node makeNode(const formats::PackView& view, uint32_t index)
{
    const formats::NodeRecord& record = view.nodes()[index];
    return {.struct_size = sizeof(hearth_pack_node),
            .parent = record.parent,
            .mesh = record.mesh,
            .skin = record.skin,
            .parent_from_node = toC(pack::parentFromNode(record)),
            .world_from_node = toC(pack::worldFromNode(view.nodes(), index))};
}

hearth_pack_mesh makeMesh(const formats::PackView& view, uint32_t index)
{
    const formats::MeshRecord& record = view.meshes()[index];
    const formats::DeformedMeshRecord* const deformed = pack::findDeformedMesh(view, index);
    const bool is_drawn = record.levels.count > 0;
    hearth_pack_mesh mesh{.struct_size = sizeof(hearth_pack_mesh),
                          .triangle_count = is_drawn ? view.levels()[record.levels.first].triangle_count : 0,
                          .level_count = record.levels.count,
                          .skin = deformed == nullptr ? kInvalidIndex : deformed->skin,
                          .morph_weight_count = record.morph_target_count,
                          .is_deformed = deformed == nullptr ? 0u : 1u,
                          .box_min = {},
                          .box_max = {}};
    const Box3 box = is_drawn ? Box3{record.box_min, record.box_max} : Box3{};
    copyVector(box.min, mesh.box_min);
    copyVector(box.max, mesh.box_max);
    return mesh;
}

/// Make the state of a light without flicker.
hearth_light_change makeLight(const formats::LightRecord& record, uint32_t index)
{
    hearth_light_change light{};
    light.light = index;
    copyRows(record.world_from_light, light.world_from_light);
    copyVector(record.color, light.color);
    light.intensity = record.intensity;
    light.range = record.range;
    light.inner_cone_rad = record.inner_cone_rad;
    light.outer_cone_rad = record.outer_cone_rad;
    light.type = HEARTH_LIGHT_SUN + record.type;
    return light;
}

} // namespace

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

hearth_result hearth_pack_get_node(const hearth_pack* pack, uint32_t index, hearth_pack_node* node,
                                   char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkRecord(pack, HEARTH_TABLE_NODES, index));
                    HEARTH_TRY(checkStruct("node", node));
                    *node = makeNode(pack->pack.view(), index);
                    return success();
                });
}

hearth_result hearth_pack_get_mesh(const hearth_pack* pack, uint32_t index, hearth_pack_mesh* mesh,
                                   char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkRecord(pack, HEARTH_TABLE_MESHES, index));
                    HEARTH_TRY(checkStruct("mesh", mesh));
                    *mesh = makeMesh(pack->pack.view(), index);
                    return success();
                });
}

hearth_result hearth_pack_get_skin(const hearth_pack* pack, uint32_t index, hearth_pack_skin* skin,
                                   char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkRecord(pack, HEARTH_TABLE_SKINS, index));
                    HEARTH_TRY(checkStruct("skin", skin));
                    const formats::SkinRecord& record = pack->pack.view().skins()[index];
                    *skin = {.struct_size = sizeof(*skin),
                             .first_joint = record.joints.first,
                             .joint_count = record.joints.count,
                             .root = record.skeleton_root};
                    return success();
                });
}

hearth_result hearth_pack_get_joint(const hearth_pack* pack, uint32_t index, hearth_pack_joint* joint,
                                    char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkRecord(pack, HEARTH_TABLE_JOINTS, index));
                    HEARTH_TRY(checkStruct("joint", joint));
                    const formats::PackView& view = pack->pack.view();
                    const formats::JointRecord& record = view.joints()[index];
                    *joint = {.struct_size = sizeof(*joint),
                              .node = record.node,
                              .parent = pack::findParentJoint(view, index),
                              .reserved = 0,
                              .joint_from_bind = toC(widened(record.joint_from_bind))};
                    return success();
                });
}

hearth_result hearth_pack_get_light(const hearth_pack* pack, uint32_t index, hearth_light_change* light,
                                    uint32_t* node, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkRecord(pack, HEARTH_TABLE_LIGHTS, index));
                    if (light == nullptr)
                        return usage("light is NULL");
                    const formats::LightRecord& record = pack->pack.view().lights()[index];
                    *light = makeLight(record, index);
                    if (node != nullptr)
                        *node = record.node;
                    return success();
                });
}
