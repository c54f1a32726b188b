// Reads buffers, buffer views and accessors, and checks all sizes and ranges against the declared lengths.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/accessors.h"
#include "pipelines/import/gltf/document/model_parts.h"

#include <fmt/format.h>

namespace hearth::import
{

namespace
{

// range of "byteStride" by the specification: 4 to 252
constexpr IntegerRange kStrideRange{4, 252};

constexpr Choice kMeshoptModes[] = {
    {"ATTRIBUTES", static_cast<uint32_t>(MeshoptMode::attributes)},
    {"TRIANGLES", static_cast<uint32_t>(MeshoptMode::triangles)},
    {"INDICES", static_cast<uint32_t>(MeshoptMode::indices)},
};
constexpr Choice kMeshoptFilters[] = {
    {"NONE", static_cast<uint32_t>(MeshoptFilter::none)},
    {"OCTAHEDRAL", static_cast<uint32_t>(MeshoptFilter::octahedral)},
    {"QUATERNION", static_cast<uint32_t>(MeshoptFilter::quaternion)},
    {"EXPONENTIAL", static_cast<uint32_t>(MeshoptFilter::exponential)},
};
constexpr Choice kElementTypes[] = {
    {"SCALAR", static_cast<uint32_t>(ElementType::scalar)},
    {"VEC2", static_cast<uint32_t>(ElementType::vec2)},
    {"VEC3", static_cast<uint32_t>(ElementType::vec3)},
    {"VEC4", static_cast<uint32_t>(ElementType::vec4)},
    {"MAT2", static_cast<uint32_t>(ElementType::mat2)},
    {"MAT3", static_cast<uint32_t>(ElementType::mat3)},
    {"MAT4", static_cast<uint32_t>(ElementType::mat4)},
};

/// True if [offset, offset + length) lies in [0, size), without overflow.
bool fits(uint64_t offset, uint64_t length, uint64_t size)
{
    return offset <= size && length <= size - offset;
}

/// True if `count` elements of `size` bytes at distance `stride` fit, the last one without its gap.
bool elementsFit(uint64_t offset, uint64_t count, uint64_t size, uint64_t stride, uint64_t available)
{
    if (!fits(offset, size, available))
        return false;
    return count <= (available - offset - size) / stride + 1;
}

ComponentType readComponentType(const GltfObject& object, bool index)
{
    const auto type = static_cast<ComponentType>(object.integer("componentType", {}, std::nullopt));
    const bool is_index =
        type == ComponentType::u8 || type == ComponentType::u16 || type == ComponentType::u32;
    const bool known =
        is_index || type == ComponentType::i8 || type == ComponentType::i16 || type == ComponentType::f32;
    if (known && (is_index || !index))
        return type;
    object.problems().fail(Issue::gltf_value, object.json(),
                           fmt::format("componentType {} is not allowed here", static_cast<uint32_t>(type)));
    return index ? ComponentType::u16 : ComponentType::f32;
}

GltfMeshopt readMeshopt(const GltfObject& object, const GltfModel& model)
{
    GltfMeshopt meshopt;
    meshopt.buffer = object.index("buffer", model.buffers.size(), Need::required);
    meshopt.byte_offset = object.integer("byteOffset", {}, 0);
    meshopt.byte_length = object.integer("byteLength", {1}, std::nullopt);
    meshopt.byte_stride = object.integer("byteStride", {1, 256}, std::nullopt);
    meshopt.count = object.integer("count", {1, UINT32_MAX}, std::nullopt);
    meshopt.mode = static_cast<MeshoptMode>(object.choice("mode", kMeshoptModes, std::nullopt));
    meshopt.filter = static_cast<MeshoptFilter>(
        object.choice("filter", kMeshoptFilters, static_cast<uint32_t>(MeshoptFilter::none)));
    if (meshopt.buffer != kInvalidIndex &&
        !fits(meshopt.byte_offset, meshopt.byte_length, model.buffers[meshopt.buffer].byte_length))
        object.problems().fail(Issue::gltf_bounds, object.json(),
                               fmt::format("the compressed data do not fit in buffer {}", meshopt.buffer));
    return meshopt;
}

GltfSparse readSparse(const GltfObject& object, const GltfAccessor& accessor, const GltfModel& model)
{
    GltfSparse sparse;
    sparse.count = object.integer("count", {1, accessor.count}, std::nullopt);
    const std::optional<GltfObject> indices = object.object("indices", Need::required);
    const std::optional<GltfObject> values = object.object("values", Need::required);
    if (!indices || !values)
        return sparse;
    sparse.indices_view = indices->index("bufferView", model.buffer_views.size(), Need::required);
    sparse.indices_offset = indices->integer("byteOffset", {}, 0);
    sparse.indices_type = readComponentType(*indices, true);
    sparse.values_view = values->index("bufferView", model.buffer_views.size(), Need::required);
    sparse.values_offset = values->integer("byteOffset", {}, 0);

    const uint64_t index_size = componentSize(sparse.indices_type);
    const uint64_t value_size = elementSize(accessor.component, accessor.type);
    const auto check = [&](const GltfObject& part, uint32_t view, uint64_t offset, uint64_t size)
    {
        if (view != kInvalidIndex &&
            !elementsFit(offset, sparse.count, size, size, model.buffer_views[view].byte_length))
            part.problems().fail(Issue::gltf_bounds, part.json(),
                                 fmt::format("{} elements do not fit in buffer view {}", sparse.count, view));
    };
    check(*indices, sparse.indices_view, sparse.indices_offset, index_size);
    check(*values, sparse.values_view, sparse.values_offset, value_size);
    return sparse;
}

void checkAccessorFits(const GltfObject& object, const GltfAccessor& accessor, const GltfModel& model)
{
    if (accessor.buffer_view == kInvalidIndex)
        return;
    const GltfBufferView& view = model.buffer_views[accessor.buffer_view];
    const uint64_t size = elementSize(accessor.component, accessor.type);
    const uint64_t stride = view.byte_stride == 0 ? size : view.byte_stride;
    if (stride < size)
        object.problems().fail(
            Issue::gltf_value, object.json(),
            fmt::format("elements of {} bytes overlap at a byteStride of {}", size, stride));
    else if (!elementsFit(accessor.byte_offset, accessor.count, size, stride, view.byte_length))
        object.problems().fail(
            Issue::gltf_bounds, object.json(),
            fmt::format("{} elements of {} bytes at offset {} do not fit in buffer view {} of {} bytes",
                        accessor.count, size, accessor.byte_offset, accessor.buffer_view, view.byte_length));
}

} // namespace

void readBuffers(const GltfObject& root, GltfModel& model)
{
    for (const GltfObject& object : root.objects("buffers"))
    {
        GltfBuffer& buffer = model.buffers.emplace_back();
        if (object.has("uri"))
            buffer.uri = object.text("uri");
        buffer.byte_length = object.integer("byteLength", {1}, std::nullopt);
        if (const auto meshopt = object.extension("EXT_meshopt_compression"))
            buffer.fallback = meshopt->boolean("fallback", false);
    }
}

void readBufferViews(const GltfObject& root, GltfModel& model)
{
    for (const GltfObject& object : root.objects("bufferViews"))
    {
        GltfBufferView view;
        view.buffer = object.index("buffer", model.buffers.size(), Need::required);
        view.byte_offset = object.integer("byteOffset", {}, 0);
        view.byte_length = object.integer("byteLength", {1}, std::nullopt);
        if (object.has("byteStride"))
            view.byte_stride = object.integer("byteStride", kStrideRange, std::nullopt);
        if (const auto meshopt = object.extension("EXT_meshopt_compression"))
            view.meshopt = readMeshopt(*meshopt, model);
        if (view.buffer != kInvalidIndex &&
            !fits(view.byte_offset, view.byte_length, model.buffers[view.buffer].byte_length))
            object.problems().fail(Issue::gltf_bounds, object.json(),
                                   fmt::format("{} bytes at offset {} do not fit in buffer {} of {} bytes",
                                               view.byte_length, view.byte_offset, view.buffer,
                                               model.buffers[view.buffer].byte_length));
        model.buffer_views.push_back(view);
    }
}

void readAccessors(const GltfObject& root, GltfModel& model)
{
    for (const GltfObject& object : root.objects("accessors"))
    {
        GltfAccessor accessor;
        accessor.buffer_view = object.index("bufferView", model.buffer_views.size());
        accessor.byte_offset = object.integer("byteOffset", {}, 0);
        accessor.component = readComponentType(object, false);
        accessor.type = static_cast<ElementType>(object.choice("type", kElementTypes, std::nullopt));
        accessor.normalized = object.boolean("normalized", false);
        accessor.count = object.integer("count", {1}, std::nullopt);
        checkAccessorFits(object, accessor, model);
        if (const auto sparse = object.object("sparse"))
            accessor.sparse = readSparse(*sparse, accessor, model);
        model.accessors.push_back(accessor);
    }
}

} // namespace hearth::import
