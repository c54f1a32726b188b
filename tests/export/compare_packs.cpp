// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/export/compare_packs.h"

#include "formats/pack/decode_image.h"
#include "formats/scene/animation.h"
#include "formats/texels/swizzle.h"
#include "tests/reference/pack_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

namespace hearth::test
{

using namespace formats;

namespace
{

/// Return the triangles of a mesh that no simplification made, sorted.
std::vector<SortedTriangle> sortTriangles(const PackView& pack, const reference::PackGeometry& geometry,
                                          uint32_t mesh)
{
    std::vector<SortedTriangle> triangles;
    const Range clusters = pack.meshes()[mesh].clusters;
    for (uint32_t cluster = clusters.first; cluster < clusters.first + clusters.count; ++cluster)
        if (pack.clusters()[cluster].refined_group == kInvalidIndex)
            for (const auto& corners : geometry.triangles(cluster))
                triangles.push_back(sortCorners(corners, pack.clusters()[cluster].material));
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

/// Return the sorted triangles of each mesh that an instance draws.
std::map<uint32_t, std::vector<SortedTriangle>> findDrawnMeshes(const PackView& pack)
{
    const auto geometry = reference::PackGeometry::decode(pack);
    std::map<uint32_t, std::vector<SortedTriangle>> meshes;
    for (const InstanceRecord& instance : pack.instances())
        if (!meshes.contains(instance.mesh))
            meshes[instance.mesh] = sortTriangles(pack, *geometry, instance.mesh);
    return meshes;
}

template <typename T>
void expectEqual(Differences& differences, const std::string& what, const T& a, const T& b)
{
    if (a == b)
        return;
    std::ostringstream text;
    text.precision(9);
    text << what << ": " << a << " and " << b;
    differences.push_back(text.str());
}

void expectNear(Differences& differences, const std::string& what, double a, double b, double error)
{
    if (!(std::abs(a - b) <= error))
        expectEqual(differences, what, a, b);
}

void expectNear(Differences& differences, const std::string& what, const Affine3& a, const Affine3& b,
                double error)
{
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            expectNear(differences, what, double{a.m[row][column]}, double{b.m[row][column]}, error);
}

void expectEqual(Differences& differences, const std::string& what, Float3 a, Float3 b)
{
    expectEqual(differences, what + " x", a.x, b.x);
    expectEqual(differences, what + " y", a.y, b.y);
    expectEqual(differences, what + " z", a.z, b.z);
}

/// Largest coordinate of the scene: rounding errors of transforms are in proportion.
double measureScene(const PackView& pack)
{
    double size = 1;
    for (const InstanceRecord& instance : pack.instances())
        for (const auto& row : instance.world_from_object.m)
            for (const float number : row)
                size = std::max(size, std::abs(double{number}));
    return size;
}

struct TextureSlot
{
    std::string name;
    TextureRef reference;
};

std::vector<TextureSlot> listSlots(const PackView& pack, uint32_t material)
{
    const MaterialRecord& m = pack.materials()[material];
    std::vector<TextureSlot> slots{{"base colour", m.base_color_texture},
                                   {"metallic-roughness", m.metallic_roughness_texture},
                                   {"normal", m.normal_texture},
                                   {"occlusion", m.occlusion_texture},
                                   {"emissive", m.emissive_texture}};
    const MaterialLayersRecord* const found = findLayers(pack.materialLayers(), material);
    const MaterialLayersRecord layers = found != nullptr ? *found : neutralLayers(material);
    slots.push_back({"specular", layers.specular_texture});
    slots.push_back({"clear coat", layers.clearcoat_texture});
    slots.push_back({"clear coat normal", layers.clearcoat_normal_texture});
    slots.push_back({"sheen", layers.sheen_texture});
    return slots;
}

std::vector<DecodedTexel> readTexels(const PackView& pack, uint32_t image)
{
    const ImageRecord& record = pack.images()[image];
    const auto data = pack.imageData(image);
    std::vector<DecodedTexel> texels = decodeImageMip(record, data->bytes(), 0);
    applySwizzle(texels, record.swizzle, 0xFFFF);
    return texels;
}

/// Return the unit normal of the red and green that shaders read.
Double3 readNormal(const DecodedTexel& texel)
{
    const double x = texel[0] / 32767.5 - 1, y = texel[1] / 32767.5 - 1;
    const double z = std::sqrt(std::max(0.0, 1 - x * x - y * y)), size = std::sqrt(x * x + y * y + z * z);
    return {x / size, y / size, z / size};
}

/// Return the root mean square of the angles between normals, or of the differences of a texture's channels.
double measureLoss(const std::vector<DecodedTexel>& a, const std::vector<DecodedTexel>& b, bool is_normal,
                   const std::vector<size_t>& channels)
{
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i)
    {
        if (is_normal)
        {
            const double angle = std::acos(std::min(1.0, dot(readNormal(a[i]), readNormal(b[i]))));
            sum += angle * angle;
            ++count;
            continue;
        }
        for (const size_t c : channels)
        {
            const double difference = (a[i][c] - b[i][c]) / 65535.0;
            sum += difference * difference;
            ++count;
        }
    }
    return std::sqrt(sum / static_cast<double>(count));
}

/// Computes where a clip takes the vertices of instances.
class ClipSampler
{
public:
    explicit ClipSampler(const PackView& pack)
        : pack_(pack),
          tables_(animationTables(pack)),
          order_(nodesParentsFirst(pack.nodes())),
          geometry_(*reference::PackGeometry::decode(pack))
    {
    }

    /// Posed places of the vertices of an instance, by their places at rest.
    std::multimap<std::array<float, 3>, Double3> vertices(const InstanceRecord& instance, uint32_t clip,
                                                          double time) const
    {
        const auto [pose, world] = poseAt(clip, time);
        const NodeRecord& node = pack_.nodes()[instance.node];
        std::vector<Affine3d> palette{world[instance.node]};
        if (node.skin != kInvalidIndex)
        {
            const SkinRecord& skin = pack_.skins()[node.skin];
            palette.resize(skin.joints.count);
            skinPalette(tables_, skin, world, palette);
        }
        const auto weights = recordsInRange(std::span<const double>(pose.morph_weights), node.morph_weights);
        std::multimap<std::array<float, 3>, Double3> places;
        const Range clusters = pack_.meshes()[instance.mesh].clusters;
        for (uint32_t cluster = clusters.first; cluster < clusters.first + clusters.count; ++cluster)
            if (pack_.clusters()[cluster].refined_group == kInvalidIndex)
                addVertices(geometry_.cluster(cluster), palette, weights, places);
        return places;
    }

private:
    std::pair<ScenePose, std::vector<Affine3d>> poseAt(uint32_t clip, double time) const
    {
        ScenePose pose = restPose(tables_);
        sampleAnimation(tables_, tables_.animations[clip], time, pose);
        std::vector<Affine3d> world(pack_.nodes().size());
        poseNodes(tables_, pose, order_, world);
        return {std::move(pose), std::move(world)};
    }

    static void addVertices(const ClusterGeometry& geometry, std::span<const Affine3d> palette,
                            std::span<const double> weights,
                            std::multimap<std::array<float, 3>, Double3>& places)
    {
        for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
        {
            const Float3 rest = geometry.position(v);
            Double3 position{double{rest.x}, double{rest.y}, double{rest.z}};
            for (uint32_t i = 0; i < geometry.morphCount(); ++i)
            {
                const Float3 delta = geometry.morphPosition(i, v);
                position = position + Double3{double{delta.x}, double{delta.y}, double{delta.z}} *
                                          weights[geometry.morphTarget(i)];
            }
            Double3 placed =
                geometry.influenceCount() == 0 ? transformPoint(palette[0], position) : Double3{};
            for (uint32_t i = 0; i < geometry.influenceCount(); ++i)
                placed = placed + transformPoint(palette[geometry.joints(v)[i]], position) *
                                      (geometry.weightCodes(v)[i] / 65535.0);
            places.emplace(std::array{rest.x + 0.0f, rest.y + 0.0f, rest.z + 0.0f}, placed);
        }
    }

    const PackView& pack_;
    AnimationTables tables_;
    std::vector<uint32_t> order_;
    reference::PackGeometry geometry_;
};

double distance(Double3 a, Double3 b)
{
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// Return the largest distance of a posed vertex of `b` from the nearest one of `a` with the same rest.
double measureVertices(const std::multimap<std::array<float, 3>, Double3>& a,
                       const std::multimap<std::array<float, 3>, Double3>& b)
{
    double largest = 0;
    for (const auto& [rest, place] : b)
    {
        const auto [first, last] = a.equal_range(rest);
        double nearest = std::numeric_limits<double>::infinity();
        for (auto it = first; it != last; ++it)
            nearest = std::min(nearest, distance(it->second, place));
        largest = std::max(largest, nearest);
    }
    return largest;
}

} // namespace

SortedTriangle sortCorners(const std::array<Float3, 3>& corners, uint32_t material)
{
    std::array<float, 9> best{};
    for (size_t first = 0; first < 3; ++first)
    {
        std::array<float, 9> turned;
        for (size_t i = 0; i < 3; ++i)
        {
            const Float3 p = corners[(first + i) % 3];
            // 0 and -0 are one position
            turned[3 * i] = p.x + 0.0f;
            turned[3 * i + 1] = p.y + 0.0f;
            turned[3 * i + 2] = p.z + 0.0f;
        }
        if (first == 0 || turned < best)
            best = turned;
    }
    return {best, material};
}

std::vector<SortedTriangle> findDrawnTriangles(const PackView& pack)
{
    const auto meshes = findDrawnMeshes(pack);
    std::vector<SortedTriangle> triangles;
    for (const InstanceRecord& instance : pack.instances())
        triangles.insert(triangles.end(), meshes.at(instance.mesh).begin(), meshes.at(instance.mesh).end());
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

Differences compareTriangles(const PackView& a, const PackView& b)
{
    const std::vector<SortedTriangle> triangles_a = findDrawnTriangles(a),
                                      triangles_b = findDrawnTriangles(b);
    Differences differences;
    expectEqual(differences, "triangles", triangles_a.size(), triangles_b.size());
    std::vector<SortedTriangle> only_a;
    std::set_difference(triangles_a.begin(), triangles_a.end(), triangles_b.begin(), triangles_b.end(),
                        std::back_inserter(only_a));
    std::ostringstream first;
    for (size_t i = 0; !only_a.empty() && i < 9; ++i)
        first << ' ' << only_a.front().positions[i];
    expectEqual(differences,
                "triangles that the second lacks, the first of which has the corners" + first.str(),
                only_a.size(), size_t{0});
    return differences;
}

Differences compareInstances(const PackView& a, const PackView& b)
{
    Differences differences;
    expectEqual(differences, "instances", a.instances().size(), b.instances().size());
    if (!differences.empty())
        return differences;
    const double error = 1e-6 * measureScene(a);
    const auto meshes_a = findDrawnMeshes(a), meshes_b = findDrawnMeshes(b);
    std::vector<bool> used(b.instances().size());
    for (const InstanceRecord& instance : a.instances())
    {
        Differences nearest{"no instance"};
        for (size_t i = 0; i < b.instances().size() && !nearest.empty(); ++i)
        {
            const InstanceRecord& other = b.instances()[i];
            if (used[i] || meshes_a.at(instance.mesh).size() != meshes_b.at(other.mesh).size())
                continue;
            nearest.clear();
            expectNear(nearest, "instance", instance.world_from_object, other.world_from_object, error);
            if (nearest.empty() && meshes_a.at(instance.mesh) != meshes_b.at(other.mesh))
                nearest.push_back("triangles");
            used[i] = nearest.empty();
        }
        if (!nearest.empty())
            differences.push_back("no instance is like that of node " + std::to_string(instance.node));
    }
    return differences;
}

Differences compareMaterials(const PackView& a, const PackView& b)
{
    Differences differences;
    expectEqual(differences, "materials", a.materials().size(), b.materials().size());
    for (uint32_t i = 0; differences.empty() && i < a.materials().size(); ++i)
    {
        const MaterialRecord &x = a.materials()[i], &y = b.materials()[i];
        const std::string where = "material " + std::to_string(i) + " ";
        expectEqual(differences, where + "name", a.text(x.name), b.text(y.name));
        expectEqual(differences, where + "flags", x.flags, y.flags);
        expectEqual(differences, where + "alpha mode", x.alpha_mode, y.alpha_mode);
        if (x.alpha_mode == static_cast<uint32_t>(AlphaMode::mask))
            expectEqual(differences, where + "alpha cutoff", x.alpha_cutoff, y.alpha_cutoff);
        expectEqual(differences, where + "base colour",
                    Float3{x.base_color.x, x.base_color.y, x.base_color.z},
                    Float3{y.base_color.x, y.base_color.y, y.base_color.z});
        expectEqual(differences, where + "alpha", x.base_color.w, y.base_color.w);
        expectEqual(differences, where + "emissive", x.emissive, y.emissive);
        expectEqual(differences, where + "metallic", x.metallic, y.metallic);
        expectEqual(differences, where + "roughness", x.roughness, y.roughness);
        expectEqual(differences, where + "normal scale", x.normal_scale, y.normal_scale);
        expectEqual(differences, where + "occlusion strength", x.occlusion_strength, y.occlusion_strength);
        const auto slots_a = listSlots(a, i), slots_b = listSlots(b, i);
        for (size_t slot = 0; slot < slots_a.size(); ++slot)
        {
            const TextureRef &s = slots_a[slot].reference, &t = slots_b[slot].reference;
            const std::string texture = where + slots_a[slot].name + " ";
            expectEqual(differences, texture + "exists", s.image != kInvalidIndex, t.image != kInvalidIndex);
            expectEqual(differences, texture + "UV set", int{s.uv_set}, int{t.uv_set});
            expectEqual(differences, texture + "wrap", s.wrap_u * 4 + s.wrap_v, t.wrap_u * 4 + t.wrap_v);
            expectEqual(differences, texture + "filter", int{s.nearest}, int{t.nearest});
            for (size_t n = 0; n < 6; ++n)
                expectNear(differences, texture + "transform", double{s.uv_transform[n]},
                           double{t.uv_transform[n]}, 1e-5);
        }
        const auto *l = findLayers(a.materialLayers(), i), *m = findLayers(b.materialLayers(), i);
        expectEqual(differences, where + "layers", l != nullptr, m != nullptr);
        if (l == nullptr || m == nullptr)
            continue;
        expectEqual(differences, where + "ior", l->ior, m->ior);
        expectEqual(differences, where + "specular", l->specular, m->specular);
        expectEqual(differences, where + "specular colour", l->specular_color, m->specular_color);
        expectEqual(differences, where + "clear coat", l->clearcoat, m->clearcoat);
        expectEqual(differences, where + "its roughness", l->clearcoat_roughness, m->clearcoat_roughness);
        expectEqual(differences, where + "its normal scale", l->clearcoat_normal_scale,
                    m->clearcoat_normal_scale);
        expectEqual(differences, where + "sheen", l->sheen_color, m->sheen_color);
        expectEqual(differences, where + "its roughness", l->sheen_roughness, m->sheen_roughness);
    }
    return differences;
}

Differences compareTexels(const PackView& a, const PackView& b, uint32_t max_step)
{
    Differences differences;
    for (uint32_t i = 0; i < a.materials().size(); ++i)
    {
        const auto slots_a = listSlots(a, i), slots_b = listSlots(b, i);
        for (size_t slot = 0; slot < slots_a.size(); ++slot)
        {
            const uint32_t image_a = slots_a[slot].reference.image, image_b = slots_b[slot].reference.image;
            if (image_a == kInvalidIndex || image_b == kInvalidIndex)
                continue;
            const std::string where = "material " + std::to_string(i) + " " + slots_a[slot].name;
            const ImageRecord &x = a.images()[image_a], &y = b.images()[image_b];
            expectEqual(differences, where + " width", x.width, y.width);
            expectEqual(differences, where + " height", x.height, y.height);
            if (x.width != y.width || x.height != y.height)
                continue;
            const auto texels_a = readTexels(a, image_a), texels_b = readTexels(b, image_b);
            uint32_t largest = 0;
            const size_t channels = (x.flags & kImageNormalMap) != 0 ? 2 : 4;
            for (size_t texel = 0; texel < texels_a.size(); ++texel)
                for (size_t c = 0; c < channels; ++c)
                    largest = std::max<uint32_t>(
                        largest, static_cast<uint32_t>(std::abs(texels_a[texel][c] - texels_b[texel][c])));
            if (largest > max_step)
                expectEqual(differences, where + " largest difference of texels", largest, max_step);
        }
    }
    return differences;
}

Differences compareLoss(const PackView& source, const PackView& encoded, const PackView& decoded)
{
    Differences differences;
    size_t compared = 0;
    for (uint32_t i = 0; i < encoded.materials().size(); ++i)
    {
        const auto slots = listSlots(encoded, i), first = listSlots(source, i), last = listSlots(decoded, i);
        for (size_t slot = 0; slot < slots.size(); ++slot)
        {
            if (slots[slot].reference.image == kInvalidIndex)
                continue;
            const ImageRecord& record = encoded.images()[slots[slot].reference.image];
            if (!(record.error > 0))
                continue;
            const std::vector<size_t> channels =
                slots[slot].name == "metallic-roughness" ? std::vector<size_t>{1, 2}
                : slots[slot].name == "occlusion"        ? std::vector<size_t>{0}
                                                         : std::vector<size_t>{0, 1, 2};
            const double loss = measureLoss(readTexels(source, first[slot].reference.image),
                                            readTexels(decoded, last[slot].reference.image),
                                            (record.flags & kImageNormalMap) != 0, channels);
            ++compared;
            if (!(loss <= 2 * double{record.error}))
                expectEqual(differences, "material " + std::to_string(i) + " " + slots[slot].name + " loss",
                            loss, double{record.error});
        }
    }
    if (compared == 0)
        differences.push_back("no texture has a lossy format");
    return differences;
}

Differences compareScenes(const PackView& a, const PackView& b)
{
    Differences differences;
    const auto name = [](const PackView& pack, StringRef text) { return std::string(pack.text(text)); };
    // a file has a node more for each further copy of a mesh
    for (uint32_t i = 0; i < a.nodes().size(); ++i)
    {
        const NodeRecord &x = a.nodes()[i], &y = b.nodes()[i];
        const std::string where = "node " + std::to_string(i) + " ";
        expectEqual(differences, where + "name", name(a, x.name), name(b, y.name));
        expectEqual(differences, where + "parent", x.parent, y.parent);
        expectNear(differences, where + "transform", x.parent_from_node, y.parent_from_node, 1e-6);
    }
    expectEqual(differences, "lights", a.lights().size(), b.lights().size());
    for (uint32_t i = 0; i < std::min(a.lights().size(), b.lights().size()); ++i)
    {
        const LightRecord &x = a.lights()[i], &y = b.lights()[i];
        const std::string where = "light " + std::to_string(i) + " ";
        expectEqual(differences, where + "name", name(a, x.name), name(b, y.name));
        expectEqual(differences, where + "type", x.type, y.type);
        expectEqual(differences, where + "node", x.node, y.node);
        expectEqual(differences, where + "colour", x.color, y.color);
        expectEqual(differences, where + "intensity", x.intensity, y.intensity);
        expectEqual(differences, where + "range", x.range, y.range);
        expectNear(differences, where + "inner cone", double{x.inner_cone_rad}, double{y.inner_cone_rad},
                   1e-6);
        expectEqual(differences, where + "outer cone", x.outer_cone_rad, y.outer_cone_rad);
        expectEqual(differences, where + "flicker", x.flicker_rate, y.flicker_rate);
    }
    expectEqual(differences, "cameras", a.cameras().size(), b.cameras().size());
    for (uint32_t i = 0; i < std::min(a.cameras().size(), b.cameras().size()); ++i)
    {
        const CameraRecord &x = a.cameras()[i], &y = b.cameras()[i];
        const std::string where = "camera " + std::to_string(i) + " ";
        expectEqual(differences, where + "name", name(a, x.name), name(b, y.name));
        expectEqual(differences, where + "type", x.type, y.type);
        expectEqual(differences, where + "node", x.node, y.node);
        expectEqual(differences, where + "angle", x.y_fov_rad, y.y_fov_rad);
        expectEqual(differences, where + "aspect", x.aspect, y.aspect);
        expectEqual(differences, where + "width", x.x_magnification, y.x_magnification);
        expectEqual(differences, where + "height", x.y_magnification, y.y_magnification);
        expectEqual(differences, where + "near", x.z_near, y.z_near);
        expectEqual(differences, where + "far", x.z_far, y.z_far);
    }
    expectEqual(differences, "skins", a.skins().size(), b.skins().size());
    expectEqual(differences, "joints", a.joints().size(), b.joints().size());
    for (uint32_t i = 0; i < std::min(a.joints().size(), b.joints().size()); ++i)
    {
        expectEqual(differences, "joint " + std::to_string(i), a.joints()[i].node, b.joints()[i].node);
        expectNear(differences, "bind matrix " + std::to_string(i), a.joints()[i].joint_from_bind,
                   b.joints()[i].joint_from_bind, 0);
    }
    expectEqual(differences, "extras", a.extras().size(), b.extras().size());
    expectEqual(differences, "shadow spheres", a.shadowSpheres().size(), b.shadowSpheres().size());
    return differences;
}

Differences compareClips(const PackView& a, const PackView& b)
{
    Differences differences;
    expectEqual(differences, "clips", a.animations().size(), b.animations().size());
    if (!differences.empty() || a.animations().empty())
        return differences;
    constexpr int kTimes = 20;
    const double rounding = 1e-5 * measureScene(a);
    const ClipSampler sampler_a(a), sampler_b(b);
    for (uint32_t clip = 0; clip < a.animations().size(); ++clip)
    {
        const AnimationRecord &x = a.animations()[clip], &y = b.animations()[clip];
        const std::string where = "clip " + std::to_string(clip) + " ";
        expectEqual(differences, where + "name", std::string(a.text(x.name)), std::string(b.text(y.name)));
        expectEqual(differences, where + "duration", x.duration, y.duration);
        double largest = 0;
        for (int i = 0; i <= kTimes; ++i)
        {
            const double time = double{x.duration} * i / kTimes;
            for (const InstanceRecord& instance : a.instances())
                for (const InstanceRecord& other : b.instances())
                    if (instance.node == other.node)
                        largest = std::max(largest, measureVertices(sampler_a.vertices(instance, clip, time),
                                                                    sampler_b.vertices(other, clip, time)));
        }
        expectNear(differences, where + "takes a vertex elsewhere", largest, 0.0,
                   double{x.error} + double{y.error} + rounding);
    }
    return differences;
}

} // namespace hearth::test
