// Reads the elements of accessors as numbers: handles strides, sparse replacement and normalised integers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/buffers.h"

namespace hearth::import
{

/// Return the bytes of one element; the columns of small matrices start at multiples of 4 bytes.
uint32_t elementSize(ComponentType component, ElementType type);

/// Return the format for messages: "VEC3 of signed 16-bit integers".
std::string formatName(const GltfAccessor& accessor);

class GltfAccessors
{
public:
    GltfAccessors(const GltfModel& model, const GltfBuffers& buffers, const GltfContext& context)
        : model_(model), buffers_(buffers), context_(context)
    {
    }

    const GltfAccessor& accessor(uint32_t index) const { return model_.accessors[index]; }

    /// Return all components, element after element. Integers that are `normalized` become -1..1 or 0..1,
    /// others keep their value; floats are unchanged, even if they are not finite.
    /// errors: gltf_data (sparse indices), input_too_large (elements without data).
    Result<std::vector<float>> floats(uint32_t index);

    /// Return all components of an accessor of unsigned integers (asserted). errors: those of floats.
    Result<std::vector<uint32_t>> integers(uint32_t index);

    Error error(uint32_t index, Issue issue, std::string detail) const;

private:
    /// Return the elements without gaps.
    Result<std::vector<std::byte>> elements(uint32_t index);
    Status replaceSparse(uint32_t index, std::span<std::byte> elements) const;

    const GltfModel& model_;
    const GltfBuffers& buffers_;
    const GltfContext& context_;
    uint64_t zero_bytes_ = 0; ///< total so far, of accessors without data
};

} // namespace hearth::import
