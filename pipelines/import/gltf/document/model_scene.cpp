// Reads nodes, scenes, cameras and punctual lights.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/model_parts.h"
#include "pipelines/import/gltf/document/places.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace hearth::import
{

namespace
{

constexpr float kMinPositive = std::numeric_limits<float>::min();
constexpr float kPi = std::numbers::pi_v<float>;

constexpr Choice kCameraTypes[] = {
    {"perspective", static_cast<uint32_t>(formats::CameraType::perspective)},
    {"orthographic", static_cast<uint32_t>(formats::CameraType::orthographic)},
};
constexpr Choice kLightTypes[] = {
    {"directional", static_cast<uint32_t>(formats::LightType::directional)},
    {"point", static_cast<uint32_t>(formats::LightType::point)},
    {"spot", static_cast<uint32_t>(formats::LightType::spot)},
};

void readPerspective(const GltfObject& object, GltfCamera& camera)
{
    // one tenth of a degree to almost a half turn: no image can be rendered beyond
    camera.y_fov_rad = object.factor("yfov", 1, 0.0017f, kPi - 0.0017f);
    camera.aspect = object.factor("aspectRatio", 0, 0, kUnbounded);
    camera.z_near = object.factor("znear", 0.01f, kMinPositive, kUnbounded);
    camera.z_far = object.factor("zfar", 0, 0, kUnbounded);
}

void readOrthographic(const GltfObject& object, GltfCamera& camera)
{
    camera.x_magnification = object.number("xmag", std::nullopt);
    camera.y_magnification = object.number("ymag", std::nullopt);
    camera.z_near = object.factor("znear", 0, 0, kUnbounded);
    camera.z_far = object.factor("zfar", 1, kMinPositive, kUnbounded);
    if (camera.x_magnification == 0 || camera.y_magnification == 0)
        object.problems().fail(Issue::gltf_value, object.json(), "a magnification is 0");
}

/// Return the rotation with length 1; exporters that round to a few digits get no warning.
std::array<float, 4> unitRotation(const GltfObject& object, const std::array<float, 4>& rotation)
{
    constexpr double kRounding = 1e-3;
    double square = 0;
    for (const float value : rotation)
        square += static_cast<double>(value) * static_cast<double>(value);
    const double length = std::sqrt(square);
    if (std::abs(length - 1.0) > kRounding)
        object.problems().warn(Issue::repaired, object.json(),
                               fmt::format("the rotation has length {:.6g} instead of 1", length));
    if (length == 0.0)
        return {0, 0, 0, 1};
    std::array<float, 4> unit;
    for (size_t i = 0; i < 4; ++i)
        unit[i] = static_cast<float>(static_cast<double>(rotation[i]) / length);
    return unit;
}

void readMatrix(const GltfObject& object, GltfNode& node)
{
    constexpr float kTolerance = 1e-4f;
    node.has_trs = false;
    const auto matrix = object.numbers<16>("matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    const auto differs = [&](size_t i, float wanted) { return std::abs(matrix[i] - wanted) > kTolerance; };
    if (differs(3, 0) || differs(7, 0) || differs(11, 0) || differs(15, 1))
        object.problems().fail(Issue::gltf_value, object.json(), "the last row of the matrix is not 0 0 0 1");
    node.parent_from_node = transformFromColumns(matrix);
}

void readTransform(const GltfObject& object, GltfNode& node)
{
    if (object.has("matrix"))
        return readMatrix(object, node);
    node.translation = object.numbers<3>("translation", {0, 0, 0});
    node.rotation = unitRotation(object, object.numbers<4>("rotation", {0, 0, 0, 1}));
    node.scale = object.numbers<3>("scale", {1, 1, 1});
    node.parent_from_node = transformFromTrs(node.translation, node.rotation, node.scale);
}

/// Return the nodes that are levels of detail; numbers of missing nodes are dropped.
std::vector<uint32_t> readLods(const GltfObject& lod, size_t node_count)
{
    std::vector<uint32_t> nodes;
    for (const float id : lod.numberList("ids"))
    {
        if (id >= 0 && static_cast<double>(id) < static_cast<double>(node_count) && std::floor(id) == id)
            nodes.push_back(static_cast<uint32_t>(id));
        else
            lod.problems().warn(Issue::dropped, lod.json(),
                                fmt::format("level of detail {:g} is no node: it is not kept", id));
    }
    return nodes;
}

void readNodeExtensions(const GltfObject& object, const GltfModel& model, size_t node_count, GltfNode& node)
{
    if (const auto lod = object.extension("MSFT_lod"))
        node.lods = readLods(*lod, node_count);
    if (const auto light = object.extension("KHR_lights_punctual"))
        node.light = light->index("light", model.lights.size(), Need::required);
    if (const auto instancing = object.extension("EXT_mesh_gpu_instancing"))
    {
        node.has_instancing = true;
        if (const auto attributes = instancing->object("attributes"))
            node.instancing = readAttributes(*attributes, model.accessors.size());
    }
}

/// Read a shadow sphere from the custom properties of a node (Blender writes them to extras).
void readShadowSphere(const GltfObject& object, GltfNode& node)
{
    const std::optional<Json> json = object.json().find("extras");
    if (!json || !json->isObject()) // extras may hold anything
        return;
    const GltfObject extras(*json, object.problems());
    if (!extras.has("hearth_shadow_radius"))
        return;
    GltfShadowSphere sphere;
    sphere.radius = extras.number("hearth_shadow_radius", std::nullopt);
    if (!(sphere.radius > 0))
        extras.problems().fail(Issue::gltf_value, extras.json(), "hearth_shadow_radius must be above 0");
    sphere.light = extras.text("hearth_shadow_light");
    const uint64_t texels = extras.integer("hearth_shadow_texels", {}, 0);
    if (texels != 0 && !formats::isShadowMapSize(texels))
        extras.problems().fail(
            Issue::gltf_value, extras.json(),
            fmt::format("hearth_shadow_texels is {}, but must be a power of two from {} to {}", texels,
                        formats::kMinShadowTexels, formats::kMaxShadowTexels));
    sphere.texels = static_cast<uint32_t>(texels);
    node.shadow_sphere = std::move(sphere);
}

/// Read a light's flicker from its custom properties: {"flicker": {"rate": 8, "amplitude": 0.5, "seed": 1}}.
void readFlicker(const GltfObject& object, GltfLight& light)
{
    const std::optional<Json> extras = object.json().find("extras");
    const std::optional<Json> flicker = extras ? extras->find("flicker") : std::nullopt;
    if (!flicker)
        return;
    constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
    const auto number = [&](std::string_view name, double fallback)
    {
        const std::optional<Json> value = flicker->find(name);
        return !value ? fallback : value->isNumber() ? value->number() : kMissing;
    };
    const double rate = number("rate", kMissing), amplitude = number("amplitude", kMissing);
    const double seed = number("seed", 0);
    const bool is_rate = rate >= double{kMinPositive} && rate <= double{kUnbounded};
    const bool is_amplitude = amplitude >= 0 && amplitude <= 1;
    const bool is_seed =
        seed >= 0 && seed <= double{std::numeric_limits<uint32_t>::max()} && seed == std::floor(seed);
    if (is_rate && is_amplitude && is_seed)
        light.flicker = {static_cast<float>(rate), static_cast<float>(amplitude),
                         static_cast<uint32_t>(seed)};
    else
        object.problems().fail(
            Issue::gltf_extension_value, *flicker,
            fmt::format("the flicker of light \"{}\" needs {}; write {{\"rate\": 8, \"amplitude\": 0.5, "
                        "\"seed\": 1}}, or remove it",
                        light.name,
                        !is_rate        ? "a rate above 0 Hz"
                        : !is_amplitude ? "an amplitude from 0 to 1"
                                        : "an integer from 0 to 4294967295 as its seed"));
}

/// Warn of the coverages at which levels by MSFT_lod switch: Hearth chooses levels by their error.
void reportScreenCoverages(const GltfObject& root, const std::vector<GltfObject>& objects)
{
    PlaceList places;
    const JsonPath document{nullptr, root.json(), 0};
    for (size_t i = 0; i < objects.size(); ++i)
    {
        const std::optional<Json> extras = objects[i].json().find("extras");
        if (!objects[i].extension("MSFT_lod") || !extras || !extras->find("MSFT_screencoverage"))
            continue;
        const JsonPath nodes{&document, *root.json().find("nodes"), 0};
        places.add({&nodes, objects[i].json(), i});
    }
    if (!places.empty())
        root.problems().warn(Issue::lod_coverage, places.first(),
                             "MSFT_screencoverage is not used: levels switch by their error" + places.list());
}

/// Give every node its parent. errors: gltf_hierarchy if a node would have two.
void linkParents(const std::vector<GltfObject>& objects, GltfModel& model)
{
    for (uint32_t parent = 0; parent < model.nodes.size(); ++parent)
        for (const uint32_t child : model.nodes[parent].children)
        {
            if (child == kInvalidIndex)
                continue;
            if (model.nodes[child].parent != kInvalidIndex)
                objects[parent].problems().fail(
                    Issue::gltf_hierarchy, objects[parent].json(),
                    fmt::format("node {} is also a child of node {}", child, model.nodes[child].parent));
            model.nodes[child].parent = parent;
        }
}

/// Check the hierarchy for cycles: with one parent each, nodes that no root leads to form a cycle.
void checkForCycles(const std::vector<GltfObject>& objects, GltfModel& model)
{
    std::vector<bool> reached(model.nodes.size());
    std::vector<uint32_t> open;
    for (uint32_t node = 0; node < model.nodes.size(); ++node)
        if (model.nodes[node].parent == kInvalidIndex)
            open.push_back(node);
    while (!open.empty())
    {
        const uint32_t node = open.back();
        open.pop_back();
        reached[node] = true;
        open.insert(open.end(), model.nodes[node].children.begin(), model.nodes[node].children.end());
    }
    for (uint32_t node = 0; node < model.nodes.size(); ++node)
        if (!reached[node])
            return objects[node].problems().fail(Issue::gltf_hierarchy, objects[node].json(),
                                                 "the node is its own ancestor");
}

} // namespace

void readCameras(const GltfObject& root, GltfModel& model)
{
    for (const GltfObject& object : root.objects("cameras"))
    {
        GltfCamera camera;
        camera.name = object.text("name");
        camera.type = static_cast<formats::CameraType>(object.choice("type", kCameraTypes, std::nullopt));
        if (camera.type == formats::CameraType::perspective)
        {
            if (const auto perspective = object.object("perspective", Need::required))
                readPerspective(*perspective, camera);
        }
        else if (const auto orthographic = object.object("orthographic", Need::required))
            readOrthographic(*orthographic, camera);
        if (camera.z_far != 0 && camera.z_far <= camera.z_near)
        {
            object.problems().warn(Issue::repaired, object.json(),
                                   "zfar is not beyond znear: it is left out");
            camera.z_far = 0;
        }
        model.cameras.push_back(std::move(camera));
    }
}

void readLights(const GltfObject& root, GltfModel& model)
{
    const auto extension = root.extension("KHR_lights_punctual");
    if (!extension)
        return;
    for (const GltfObject& object : extension->objects("lights", Need::required))
    {
        GltfLight light;
        light.name = object.text("name");
        light.type = static_cast<formats::LightType>(object.choice("type", kLightTypes, std::nullopt));
        light.color = object.numbers<3>("color", {1, 1, 1});
        light.intensity = object.factor("intensity", 1, 0, kUnbounded);
        light.range = object.factor("range", 0, 0, kUnbounded);
        if (light.type == formats::LightType::spot)
        {
            light.outer_cone_rad = kPi / 4;
            if (const auto spot = object.object("spot"))
            {
                light.outer_cone_rad = spot->factor("outerConeAngle", kPi / 4, 0, kPi / 2);
                light.inner_cone_rad = spot->factor("innerConeAngle", 0, 0, light.outer_cone_rad);
            }
        }
        readFlicker(object, light);
        model.lights.push_back(std::move(light));
    }
}

void readNodes(const GltfObject& root, size_t skin_count, GltfModel& model)
{
    const std::vector<GltfObject> objects = root.objects("nodes");
    for (const GltfObject& object : objects)
    {
        GltfNode node;
        node.name = object.text("name");
        node.children = object.indices("children", objects.size());
        node.mesh = object.index("mesh", model.meshes.size());
        node.skin = object.index("skin", skin_count);
        node.camera = object.index("camera", model.cameras.size());
        node.weights = object.numberList("weights");
        readTransform(object, node);
        readNodeExtensions(object, model, objects.size(), node);
        readShadowSphere(object, node);
        node.proxy = readProxyMark(object);
        model.nodes.push_back(std::move(node));
    }
    // an invalid child index has been reported, and would lead outside the array
    if (!root.problems().ok())
        return;
    reportScreenCoverages(root, objects);
    linkParents(objects, model);
    if (root.problems().ok())
        checkForCycles(objects, model);
}

void readScenes(const GltfObject& root, GltfModel& model)
{
    for (const GltfObject& object : root.objects("scenes"))
    {
        GltfScene scene{object.text("name"), object.indices("nodes", model.nodes.size())};
        if (const auto light = object.extension("EXT_lights_image_based"))
            scene.image_light = light->index("light", model.image_lights.size(), Need::required);
        model.scenes.push_back(std::move(scene));
    }
    model.scene = root.index("scene", model.scenes.size());
}

} // namespace hearth::import
