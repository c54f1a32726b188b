// Chunk of the specular-occlusion table: the fraction of a GGX lobe that a visibility cone lets through. See
// FORMAT.md, "Specular occlusion"; formats/gpu_shared/specular_occlusion.h computes the lookup.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/specular_occlusion.h"
#include "formats/records/container.h"

namespace hearth::formats
{

inline constexpr uint32_t kChunkSpecular = fourCC("SPOC"); ///< SpecularTableRecord[], one at most

/// Form of Smith's masking-shadowing function.
enum class SpecularMasking : uint32_t
{
    separable = 0,
    correlated = 1,
};

enum class SpecularSpacing : uint32_t
{
    cosine = shared::kSpecularSpacingCosine,
    half_sine = shared::kSpecularSpacingHalfSine,
};

inline constexpr uint32_t kSpecularTexels =
    shared::kSpecularNodes * shared::kSpecularNodes * shared::kSpecularNodes;

/// Table of specular occlusion. It assumes that the normal lies in the plane of the reflection vector and the
/// cone's axis. With beta the angle between these two, the assumed angle between view and normal is
///     theta_o = (1 - normal_lambda) * beta / 2 + normal_lambda * min(beta, pi / 2)
/// on the side of the axis: with 0 the normal halves beta, with 1 it is as close to the axis as possible.
struct SpecularTableRecord
{
    uint32_t aperture_nodes;
    uint32_t roughness_nodes;
    uint32_t beta_nodes;
    uint32_t spacing;
    uint32_t masking;
    float normal_lambda;
    float min_roughness;
    uint32_t reserved;
    uint8_t values[kSpecularTexels];
};

/// Return the value at node i of each axis: half-angle / 90 degrees, roughness, cosine of beta.
constexpr double specularNodeAperture(uint32_t i)
{
    return static_cast<double>(i) / (shared::kSpecularNodes - 1);
}
constexpr double specularNodeRoughness(uint32_t i)
{
    constexpr double kMinRoughness = double{shared::kMinSpecularRoughness};
    return kMinRoughness + (1 - kMinRoughness) * static_cast<double>(i) / (shared::kSpecularNodes - 1);
}
constexpr double specularNodeCosBeta(uint32_t i, SpecularSpacing spacing)
{
    const double place = static_cast<double>(i) / (shared::kSpecularNodes - 1);
    return spacing == SpecularSpacing::cosine ? 2 * place - 1 : 1 - 2 * (1 - place) * (1 - place);
}

} // namespace hearth::formats

HEARTH_RECORD(hearth::formats::SpecularTableRecord, 4128,
              HEARTH_FIELD(hearth::formats::SpecularTableRecord, aperture_nodes, "16"),
              HEARTH_FIELD(hearth::formats::SpecularTableRecord, roughness_nodes, "16"),
              HEARTH_FIELD(hearth::formats::SpecularTableRecord, beta_nodes, "16"),
              HEARTH_FIELD(hearth::formats::SpecularTableRecord, spacing,
                           "of the nodes along beta: 0 cosine, 1 half sine"),
              HEARTH_FIELD(hearth::formats::SpecularTableRecord, masking,
                           "Smith's masking-shadowing: 0 separable, 1 height-correlated"),
              HEARTH_FIELD(hearth::formats::SpecularTableRecord, normal_lambda,
                           "0..1: where the normal is assumed"),
              HEARTH_FIELD(hearth::formats::SpecularTableRecord, min_roughness,
                           "of the first node: 0.089; that of the last is 1"),
              HEARTH_FIELD(hearth::formats::SpecularTableRecord, reserved, "0"),
              HEARTH_FIELD(hearth::formats::SpecularTableRecord, values,
                           "unorm8: aperture fastest, then roughness, then beta"));
