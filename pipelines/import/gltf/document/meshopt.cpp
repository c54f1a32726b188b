// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/meshopt.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace hearth::import
{

namespace
{

// Limit of the compression ratio. The densest data (all bytes equal) still cost 2 bits for 16 bytes: decoder
// output is at most 64 times its input, plus one block. Larger claims are refused before memory is allocated.
constexpr uint64_t kMaxRatio = 64;
constexpr uint64_t kBlockBytes = 8192;

/// Check the preconditions of the library. Return a description of the first violation, or nullopt.
std::optional<std::string> findViolation(const GltfMeshopt& view)
{
    const uint64_t stride = view.byte_stride;
    if (view.mode == MeshoptMode::attributes)
    {
        if (stride % 4 != 0)
            return fmt::format("a stride of {} is not a multiple of 4", stride);
        if (view.filter == MeshoptFilter::octahedral && stride != 4 && stride != 8)
            return fmt::format("the octahedral filter does not work on a stride of {}", stride);
        if (view.filter == MeshoptFilter::quaternion && stride != 8)
            return fmt::format("the quaternion filter does not work on a stride of {}", stride);
        return std::nullopt;
    }
    if (stride != 2 && stride != 4)
        return fmt::format("an index cannot have {} bytes", stride);
    if (view.filter != MeshoptFilter::none)
        return "indices have no filter";
    if (view.mode == MeshoptMode::triangles && view.count % 3 != 0)
        return fmt::format("{} indices are no triangles", view.count);
    return std::nullopt;
}

int decode(const GltfMeshopt& view, std::span<const std::byte> compressed, std::byte* decoded)
{
    const auto* data = reinterpret_cast<const unsigned char*>(compressed.data());
    switch (view.mode)
    {
    case MeshoptMode::attributes:
        return meshopt_decodeVertexBuffer(decoded, view.count, view.byte_stride, data, compressed.size());
    case MeshoptMode::triangles:
        return meshopt_decodeIndexBuffer(decoded, view.count, view.byte_stride, data, compressed.size());
    case MeshoptMode::indices:
        return meshopt_decodeIndexSequence(decoded, view.count, view.byte_stride, data, compressed.size());
    }
    return -1;
}

void unfilter(const GltfMeshopt& view, std::byte* decoded)
{
    switch (view.filter)
    {
    case MeshoptFilter::none:
        return;
    case MeshoptFilter::octahedral:
        return meshopt_decodeFilterOct(decoded, view.count, view.byte_stride);
    case MeshoptFilter::quaternion:
        return meshopt_decodeFilterQuat(decoded, view.count, view.byte_stride);
    case MeshoptFilter::exponential:
        return meshopt_decodeFilterExp(decoded, view.count, view.byte_stride);
    }
}

} // namespace

Result<std::vector<std::byte>> decodeMeshopt(const GltfMeshopt& view, std::span<const std::byte> compressed,
                                             const std::string& file, const std::string& where)
{
    if (const std::optional<std::string> reason = findViolation(view))
        return Error{Issue::gltf_extension_value, file, where, *reason};
    const uint64_t decoded_size = view.count * view.byte_stride; // at most 2^32 * 256
    if (decoded_size > compressed.size() * kMaxRatio + kBlockBytes)
        return Error{Issue::codec_failed, file, where,
                     fmt::format("{} bytes cannot come from {} compressed ones, which hold at most {}",
                                 decoded_size, compressed.size(),
                                 compressed.size() * kMaxRatio + kBlockBytes)};
    std::vector<std::byte> decoded(decoded_size);
    if (decode(view, compressed, decoded.data()) != 0)
        return Error{Issue::codec_failed, file, where, "the meshoptimizer data are damaged"};
    unfilter(view, decoded.data());
    return decoded;
}

} // namespace hearth::import
