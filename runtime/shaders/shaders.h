// Compiled shaders (SPIR-V 1.3), each named after its file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace hearth::shaders
{

/// Compilations of a shader of the pipelines that read the visibility buffer, by macro.
enum Variant : uint32_t
{
    kReadsInput,   ///< none
    kReadsSampled, ///< HEARTH_SAMPLED
    kVariantCount,
};
using VariedShader = std::array<std::span<const uint32_t>, kVariantCount>;

/// Return the name of a shader's file, with its variant: "sky.frag", "sky_sampled.frag".
std::string_view fileName(const VariedShader& shader, Variant variant);

extern const std::span<const uint32_t> cull_instances_comp;
extern const std::span<const uint32_t> cull_clusters_comp;
extern const std::span<const uint32_t> cull_clusters_deformed_comp;
extern const std::span<const uint32_t> scan_blocks_comp;
extern const std::span<const uint32_t> scan_totals_comp;
extern const std::span<const uint32_t> emit_visible_comp;
extern const std::span<const uint32_t> emit_draws_comp;
extern const std::span<const uint32_t> cull_statistics_comp;
extern const std::span<const uint32_t> cull_statistics_deformed_comp;
extern const std::span<const uint32_t> page_requests_comp;
extern const std::span<const uint32_t> page_requests_deformed_comp;
extern const std::span<const uint32_t> plan_skinning_comp;
extern const std::span<const uint32_t> skin_vertices_comp;
extern const std::span<const uint32_t> list_proxies_comp;
extern const std::span<const uint32_t> pyramid_tiles_comp;
extern const std::span<const uint32_t> pyramid_top_comp;
extern const std::span<const uint32_t> copy_words_comp;
extern const std::span<const uint32_t> list_lights_comp;
extern const std::span<const uint32_t> mark_lists_comp;
extern const std::span<const uint32_t> tile_lights_comp;
extern const std::span<const uint32_t> slot_lights_comp;
extern const std::span<const uint32_t> slot_lights_deformed_comp;
extern const std::span<const uint32_t> cell_lights_comp;
extern const std::span<const uint32_t> place_lists_comp;
extern const std::span<const uint32_t> light_statistics_comp;
extern const std::span<const uint32_t> light_faces_comp;
extern const std::span<const uint32_t> receivers_faces_comp;
extern const std::span<const uint32_t> receivers_update_comp;
extern const std::span<const uint32_t> receivers_points_vert;
extern const std::span<const uint32_t> receivers_points_frag;
extern const std::span<const uint32_t> gather_points_comp;
extern const std::span<const uint32_t> gather_rays_comp;
extern const std::span<const uint32_t> gather_smooth_comp;
extern const std::span<const uint32_t> tile_materials_comp;
extern const std::span<const uint32_t> tile_offsets_comp;
extern const std::span<const uint32_t> tile_lists_comp;
extern const std::span<const uint32_t> find_picks_comp;
extern const std::span<const uint32_t> motion_frag;
extern const std::span<const uint32_t> motion_distances_frag;
extern const std::span<const uint32_t> visibility_vert;
extern const std::span<const uint32_t> visibility_frag;
extern const std::span<const uint32_t> visibility_masked_vert;
extern const std::span<const uint32_t> visibility_masked_frag;
extern const std::span<const uint32_t> overdraw_frag;
extern const std::span<const uint32_t> overdraw_masked_frag;
extern const std::span<const uint32_t> caster_vert;
extern const std::span<const uint32_t> caster_frag;
extern const std::span<const uint32_t> caster_masked_vert;
extern const std::span<const uint32_t> caster_masked_frag;
extern const std::span<const uint32_t> caster_proxy_vert;
extern const std::span<const uint32_t> fullscreen_vert;
extern const std::span<const uint32_t> light_volume_vert;
extern const std::span<const uint32_t> mark_light_vert;
extern const std::span<const uint32_t> mark_light_frag;
extern const std::span<const uint32_t> view_bricks_frag;
extern const std::span<const uint32_t> post_vert;
extern const std::span<const uint32_t> bloom_down_frag;
extern const std::span<const uint32_t> bloom_up_frag;
extern const std::span<const uint32_t> exposure_frag;
extern const std::span<const uint32_t> final_frag;
extern const std::span<const uint32_t> final_bloom_frag;
extern const std::span<const uint32_t> final_tile_frag;
extern const std::span<const uint32_t> final_exposure_frag;
extern const std::span<const uint32_t> final_bloom_exposure_frag;
extern const std::span<const uint32_t> temporal_frag;
extern const VariedShader shaded_area_vert;
extern const VariedShader material_depth_frag;
extern const VariedShader material_stencil_frag;
extern const VariedShader shading_frag;
extern const VariedShader shading_shadowed_frag;
extern const VariedShader shading_gi_frag;
extern const VariedShader shading_shadowed_gi_frag;
extern const VariedShader surfaces_sky_frag;
extern const VariedShader surfaces_frag;
extern const VariedShader surfaces_shadowed_frag;
extern const VariedShader surfaces_gi_frag;
extern const VariedShader surfaces_shadowed_gi_frag;
extern const VariedShader add_lights_frag;
extern const VariedShader add_lights_shadowed_frag;
extern const VariedShader add_light_volume_frag;
extern const VariedShader add_light_volume_shadowed_frag;
extern const VariedShader normals_frag;
extern const VariedShader joint_normals_frag;
extern const VariedShader encoded_normals_frag;
extern const VariedShader sum_lights_frag;
extern const VariedShader sum_lights_shadowed_frag;
extern const VariedShader sum_light_volume_frag;
extern const VariedShader sum_light_volume_shadowed_frag;
extern const VariedShader join_lights_frag;
extern const VariedShader join_lights_shadowed_frag;
extern const VariedShader join_light_volume_frag;
extern const VariedShader join_light_volume_shadowed_frag;
extern const VariedShader join_encoded_lights_frag;
extern const VariedShader join_encoded_lights_shadowed_frag;
extern const VariedShader join_encoded_light_volume_frag;
extern const VariedShader join_encoded_light_volume_shadowed_frag;
extern const VariedShader summed_frag;
extern const VariedShader summed_shadowed_frag;
extern const VariedShader summed_gi_frag;
extern const VariedShader summed_shadowed_gi_frag;
extern const VariedShader joint_frag;
extern const VariedShader joint_shadowed_frag;
extern const VariedShader joint_gi_frag;
extern const VariedShader joint_shadowed_gi_frag;
extern const VariedShader marked_frag;
extern const VariedShader marked_shadowed_frag;
extern const VariedShader marked_gi_frag;
extern const VariedShader marked_shadowed_gi_frag;
extern const VariedShader view_surface_frag;
extern const VariedShader view_clusters_frag;
extern const VariedShader view_shadow_maps_frag;
extern const VariedShader view_gi_frag;
extern const VariedShader sky_frag;

} // namespace hearth::shaders
