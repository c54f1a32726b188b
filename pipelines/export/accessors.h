// Adds vertex data, indices, keys and files to the binary part of a glTF document.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/export/gltf_document.h"

#include <cstddef>
#include <span>

namespace hearth::gltf_export
{

/// Add bytes as a view that starts at a multiple of 4. Returns the view.
uint32_t addView(GltfDocument& document, std::span<const std::byte> bytes, ViewTarget target);

/// True if an accessor states its extremes: the specification wants those of positions and times.
enum class Extremes
{
    none,
    stated,
};

/// Add floats. Elements that are all 0 take no bytes.
/// values  whole elements of `type`
uint32_t addFloats(GltfDocument& document, std::span<const float> values, ElementType type, ViewTarget target,
                   Extremes extremes = Extremes::none);

/// Add numbers of 16 bits, four an element.
uint32_t addShorts(GltfDocument& document, std::span<const uint16_t> values, bool is_normalized);

/// Add vertex indices, in 16 bits where they fit.
uint32_t addIndices(GltfDocument& document, std::span<const uint32_t> indices);

} // namespace hearth::gltf_export
