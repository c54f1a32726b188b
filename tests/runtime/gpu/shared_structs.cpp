// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/shared_structs.h"

#include "formats/gpu_shared/brick_lighting.h"
#include "formats/gpu_shared/brick_view.h"
#include "formats/gpu_shared/cull_statistics.h"
#include "formats/gpu_shared/gather.h"
#include "formats/gpu_shared/light_cells.h"
#include "formats/gpu_shared/material_tiles.h"
#include "formats/gpu_shared/push_constants.h"
#include "formats/gpu_shared/queries/picks.h"
#include "formats/gpu_shared/receivers/receiver_points.h"
#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/shadow.h"
#include "formats/gpu_shared/shadows/proxy_casters.h"

#include <type_traits>

namespace hearth::test
{

namespace
{

template <typename T>
struct TypeName; // specialized for every type of a member

// Applies a macro to the name of a struct and to each of its members.
#define HEARTH_EXPAND(...) HEARTH_EXPAND4(HEARTH_EXPAND4(HEARTH_EXPAND4(__VA_ARGS__)))
#define HEARTH_EXPAND4(...) HEARTH_EXPAND2(HEARTH_EXPAND2(HEARTH_EXPAND2(__VA_ARGS__)))
#define HEARTH_EXPAND2(...) HEARTH_EXPAND1(HEARTH_EXPAND1(HEARTH_EXPAND1(__VA_ARGS__)))
#define HEARTH_EXPAND1(...) __VA_ARGS__
#define HEARTH_EACH(macro, type, ...) __VA_OPT__(HEARTH_EXPAND(HEARTH_EACH_NEXT(macro, type, __VA_ARGS__)))
#define HEARTH_EACH_NEXT(macro, type, member, ...)                                                           \
    macro(type, member) __VA_OPT__(HEARTH_EACH_AGAIN HEARTH_PARENTHESES(macro, type, __VA_ARGS__))
#define HEARTH_EACH_AGAIN() HEARTH_EACH_NEXT
#define HEARTH_PARENTHESES ()

#define HEARTH_MEMBER(type, member)                                                                          \
    makeMember<decltype(shared::type::member)>(#member, offsetof(shared::type, member)),
#define HEARTH_STRUCT(type, ...)                                                                             \
    SharedStruct                                                                                             \
    {                                                                                                        \
        #type, sizeof(shared::type),                                                                         \
        {                                                                                                    \
            HEARTH_EACH(HEARTH_MEMBER, type, __VA_ARGS__)                                                    \
        }                                                                                                    \
    }
#define HEARTH_TYPE(type, name)                                                                              \
    template <>                                                                                              \
    struct TypeName<type>                                                                                    \
    {                                                                                                        \
        static constexpr const char* value = name;                                                           \
    }

HEARTH_TYPE(uint32_t, "uint");
HEARTH_TYPE(int32_t, "int");
HEARTH_TYPE(float, "float");
HEARTH_TYPE(Float3, "float3");
HEARTH_TYPE(Float4, "float4");
HEARTH_TYPE(shared::LightGrid, "LightGrid");
HEARTH_TYPE(shared::LightCascade, "LightCascade");
HEARTH_TYPE(shared::ShadowLight, "ShadowLight");
HEARTH_TYPE(shared::ShadowMap, "ShadowMap");
HEARTH_TYPE(shared::BrickGrid, "BrickGrid");
HEARTH_TYPE(shared::EmissionBox, "EmissionBox");

template <typename T>
SharedMember makeMember(const char* name, size_t offset)
{
    using Element = std::remove_all_extents_t<T>;
    return {name, offset, TypeName<Element>::value, std::is_array_v<T> ? sizeof(Element) : 0};
}

std::vector<SharedStruct> pushStructs()
{
    return {
        HEARTH_STRUCT(PhasePush, phase),
        HEARTH_STRUCT(CullPush, first_item, item_count, phase),
        HEARTH_STRUCT(ScanBlocksPush, item_count),
        HEARTH_STRUCT(ScanTotalsPush, block_count, slot_capacity, phase),
        HEARTH_STRUCT(EmitVisiblePush, item_count, slot_capacity),
        HEARTH_STRUCT(EmitDrawsPush, bin_count, item_count, block_count, slot_capacity, phase),
        HEARTH_STRUCT(WordCopyPush, first_region),
        HEARTH_STRUCT(PageRequestPush, first_item, item_count, first_material, default_material),
        HEARTH_STRUCT(CullStatisticsPush, first_item, item_count, instance_count),
        HEARTH_STRUCT(PickPush, x, y, width, height),
        HEARTH_STRUCT(MotionPush, clip_x, clip_y, clip_w, eye, first_instance, pose_rows, reserved0,
                      reserved1, reserved2),
        HEARTH_STRUCT(TemporalPush, has_history),
        HEARTH_STRUCT(ListProxiesPush, instance_count),
        HEARTH_STRUCT(SkinningPlanPush, bin_count, first_bin, phase),
        HEARTH_STRUCT(PyramidPush, width, height),
        HEARTH_STRUCT(TilesPush, width, height, draw_count),
        HEARTH_STRUCT(LightListsPush, writes, marked_only),
        HEARTH_STRUCT(BinPush, bin, light_row, map_index, facing),
        HEARTH_STRUCT(ShadingPush, depth, material, debug_view, depth_scale, sky_occlusion, exposure,
                      filter_red, filter_green, filter_blue, filter_density),
        HEARTH_STRUCT(BloomDownPush, dims_fireflies),
        HEARTH_STRUCT(BloomUpPush, share),
        HEARTH_STRUCT(ExposurePush, key, share, has_light, has_history),
        HEARTH_STRUCT(FinalPush, width, height, exposure, filter_red, filter_green, filter_blue,
                      filter_density, bloom_strength, adds_bloom, shows_data),
    };
}

std::vector<SharedStruct> tableStructs()
{
    return {
        HEARTH_STRUCT(Instance, world_from_object_x, world_from_object_y, world_from_object_z, mesh, node,
                      flags, scale_max),
        HEARTH_STRUCT(Group, sphere_center, sphere_radius, error, level, first_cluster, cluster_count, page,
                      set_offset, position_error, normal_error, uv_error, absent, reserved0, reserved1),
        HEARTH_STRUCT(Cluster, base_x, base_y, base_z, extent_xy, extent_z, cone, cone_back, counts, material,
                      group, refined_group, page),
        HEARTH_STRUCT(MeshBounds, box_min, grid_step, box_max, reserved),
        HEARTH_STRUCT(InstanceInverse, object_from_world_x, object_from_world_y, object_from_world_z),
        HEARTH_STRUCT(InstanceState, eye_object, eye_slack, visible, cone_valid, grid_step, reserved),
        HEARTH_STRUCT(WorkItem, instance, first, count, flags),
        HEARTH_STRUCT(GroupItem, instance, first, count),
        HEARTH_STRUCT(WorkResult, mask_low, mask_high, offset, later_low, later_high),
        HEARTH_STRUCT(CopyRegion, source, target, words, reserved),
        HEARTH_STRUCT(VisibleCluster, instance, cluster),
        HEARTH_STRUCT(Pick, instance, cluster, triangle, reserved),
        HEARTH_STRUCT(Bin, first_item, item_count),
        HEARTH_STRUCT(BinDraw, vertex_count, instance_count, first_vertex, first_instance, first_slot,
                      reserved0, reserved1, reserved2),
        HEARTH_STRUCT(FrameCounters, drawn_clusters, dropped_clusters, early_clusters, reserved),
        HEARTH_STRUCT(ClusterDraw, address, counts, vertex_layout, material, base_x, base_y, base_z,
                      grid_step, position_error),
        HEARTH_STRUCT(ProxyCaster, first_position, first_index, triangle_count, is_closed, distance,
                      reserved0, reserved1, reserved2),
        HEARTH_STRUCT(ProxyChunk, instance, first_triangle),
        HEARTH_STRUCT(ProxyDraw, vertex_count, instance_count, first_vertex, first_instance, triangle_count),
        HEARTH_STRUCT(TileDraw, vertex_count, instance_count, first_vertex, first_instance),
        HEARTH_STRUCT(CullStatistics, empty_instances, outside_instances, occluded_instances, late_instances,
                      visible_instances, clusters, triangles_low, triangles_high),
    };
}

std::vector<SharedStruct> frameStructs()
{
    return {
        HEARTH_STRUCT(FrameView, clip_x, clip_y, clip_w, planes, eye, z_near, lod_scale, threshold, flags,
                      instance_count, width, height, corner_cosine, depth_scale, lod_curve, material_inputs),
        HEARTH_STRUCT(OcclusionView, clip_x, clip_y, clip_w, eye, z_near, width, height, level_count,
                      depth_scale),
        HEARTH_STRUCT(Material, base_color, emissive, alpha_cutoff, metallic, roughness, normal_scale,
                      occlusion_strength, flags, alpha_mode, textures, uv_sets, uv_rows, parameters,
                      motion_bound, reserved0, reserved1, reserved2),
        HEARTH_STRUCT(MaterialLayers, dielectric_f0, specular, sheen_color, sheen_roughness, clearcoat,
                      clearcoat_roughness, clearcoat_normal_scale, reserved, uv_rows),
        HEARTH_STRUCT(Light, position, type, direction, range, intensity, shadow_row, cone_scale, cone_offset,
                      reflector_gain, reflector_axis, reflected0, reflected1, reflected2, reflected3, passed0,
                      passed1, passed2, passed3),
        HEARTH_STRUCT(Lighting, sky_zenith, light_count, sky_horizon, exposure, sky_ground, surroundings_row,
                      transfers_row, first_list_word, first_cell_word, first_index_word, index_words,
                      list_count, first_in_view, sky_image_row, receivers_row, receiver_scale, receiver_width,
                      receiver_height, local_probe_row, local_probe_count, local_probe_side, local_probe_mips,
                      grid, cascades, tiles),
        HEARTH_STRUCT(LightGrid, right, z_near, down, slack_share, forward, slack_size, eye, is_orthographic,
                      edges, edge_lengths, slab_count, cell_count, max_columns, max_rows),
        HEARTH_STRUCT(LightCascade, begin, slab_depth, slabs_per_m, cells_per_pixel, column_step,
                      columns_per_u, row_step, rows_per_v, first_slab, slabs, rows, columns, first_cell,
                      reserved0, reserved1, reserved2),
        HEARTH_STRUCT(CellLight, center, radius, apex, range, axis, cosine, sine, slack, first_slab,
                      last_slab),
        HEARTH_STRUCT(ShadowLight, right, depth_scale, down, depth_offset, direction, perspective, origin,
                      depth_step, rounding, first_map, map_count, depth_quantum),
        HEARTH_STRUCT(ShadowMap, scale_x, scale_y, offset_x, offset_y, size, kernel, density, layer),
        HEARTH_STRUCT(ShadowBlock, lights, maps, error_bias, texel_size, reserved0, reserved1),
        HEARTH_STRUCT(BrickGrid, origin, voxel_size, voxels_x, voxels_y, voxels_z, reserved),
        HEARTH_STRUCT(BrickView, grid, face_count, first_brick, slice_bricks, slice_faces, emission_box_count,
                      light_rays, light_parts, baked_scale, emission_boxes),
        HEARTH_STRUCT(EmissionBox, box_min, factor, box_max, reserved),
        HEARTH_STRUCT(BrickGroup, brick_mask_low, brick_mask_high, first_brick),
        HEARTH_STRUCT(ReceiversPush, first_block, first_weight, codec, first_face),
        HEARTH_STRUCT(ReceiverPointsPush, first_block, first_weight, codec, texel_width, texel_height),
        HEARTH_STRUCT(ReceiverBlock, first_word, texel_count, color_count, group, lamps),
        HEARTH_STRUCT(Brick, voxel_mask_low, voxel_mask_high, face_masks, first_voxel, first_face),
        HEARTH_STRUCT(BrickLight, code, rest),
        HEARTH_STRUCT(BrickLocation, xy, z),
        HEARTH_STRUCT(GatherView, clip_x, clip_y, clip_w, eye_step, history_frames, eye, frame, tiles_x,
                      tiles_y, has_history, tile_angle, reserved, tile_size),
        HEARTH_STRUCT(GatherPoint, position, count, normal, sky, mean, has_surface, red, green, blue, wide,
                      reserved),
    };
}

} // namespace

const std::vector<SharedStruct>& sharedStructs()
{
    static const std::vector<SharedStruct> all = []
    {
        std::vector<SharedStruct> structs = pushStructs();
        for (const std::vector<SharedStruct>& more : {tableStructs(), frameStructs()})
            structs.insert(structs.end(), more.begin(), more.end());
        return structs;
    }();
    return all;
}

} // namespace hearth::test
