// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/picture/cycles.h"

#include "cook/json/json.h"
#include "formats/base/atomic_file.h"
#include "formats/base/hash_stream.h"
#include "tests/picture/programs.h"
#include "tests/picture/scenes.h"

#include <algorithm>
#include <filesystem>

namespace hearth::picture
{

namespace
{

using reference::Double3;
namespace fs = std::filesystem;

Json toJson(Double3 v)
{
    return Json::array({v.x, v.y, v.z});
}

Json toJson(Float3 v)
{
    return toJson(Double3(v));
}

/// Write the sky by direction, as an image around the whole sphere. Its radiance depends on the height alone.
Status writeSky(const reference::SceneLighting& lighting, const std::string& path)
{
    constexpr double kPi = 3.14159265358979323846;
    RadianceImage sky{8, 2048, {}};
    for (uint32_t y = 0; y < sky.height; ++y)
    {
        const double height = std::sin(kPi * (0.5 - (y + 0.5) / sky.height));
        const Double3 direction{std::sqrt(1 - height * height), height, 0};
        sky.pixels.insert(sky.pixels.end(), sky.width, lighting.radiance(direction));
    }
    return writePfm(path, sky);
}

/// Return the lights that Hearth adds to a source without any, after exposure.
Json addedLights(const SceneSetup& setup)
{
    Json lights = Json::array();
    if (setup.has_lights)
        return lights;
    for (const reference::SceneLight& light : setup.lighting.lights)
    {
        const double lux = std::max({light.intensity.x, light.intensity.y, light.intensity.z});
        lights.push_back({{"type", "directional"},
                          {"color", toJson(light.intensity / lux)},
                          {"intensity", lux},
                          {"position", toJson(Double3{})},
                          {"direction", toJson(light.direction)}});
    }
    return lights;
}

/// Hash of a job and of all that it reads.
std::string hashInputs(const std::string& job, const SceneSetup& setup, const CyclesSettings& settings)
{
    std::string all = job + readBytes(setup.source);
    std::vector<fs::path> scripts;
    for (const fs::directory_entry& entry : fs::directory_iterator(settings.scripts))
        if (entry.path().extension() == ".py")
            scripts.push_back(entry.path());
    std::sort(scripts.begin(), scripts.end());
    for (const fs::path& script : scripts)
        all += readBytes(script);
    bool is_read = false;
    return std::to_string(hashStream(
        [&]() -> std::span<const std::byte>
        {
            if (std::exchange(is_read, true))
                return {};
            return std::as_bytes(std::span(all));
        }));
}

std::vector<std::string> blenderCommand(const CyclesSettings& settings, const std::string& script)
{
    return {
        "/usr/bin/env", settings.blender, "-b", "--factory-startup", "-P", settings.scripts + "/" + script};
}

} // namespace

Status checkCycles(const CyclesSettings& settings, const std::string& report)
{
    std::vector<std::string> command = blenderCommand(settings, "closed_forms.py");
    command.insert(command.end(), {"--", report});
    return runProgram(command);
}

Result<ReferenceImages> renderWithCycles(const SceneSetup& setup, const CyclesSettings& settings,
                                         const std::string& prefix)
{
    const std::string open = prefix + "-cycles-open.pfm";
    const std::string full[2] = {prefix + "-cycles-full-0.pfm", prefix + "-cycles-full-1.pfm"};
    HEARTH_TRY(writeSky(setup.lighting, prefix + "-sky.pfm"));
    const Json job{{"source", setup.source},
                   {"exposure", setup.lighting.exposure},
                   {"added_lights", addedLights(setup)},
                   {"sky", prefix + "-sky.pfm"},
                   {"camera", Json{{"position", toJson(setup.camera.position)},
                                   {"target", toJson(setup.camera.target)},
                                   {"up", toJson(setup.camera.up)},
                                   {"y_fov_rad", setup.camera.y_fov_rad},
                                   {"z_near", setup.camera.z_near}}},
                   {"width", kWidth * kOversampling},
                   {"height", kHeight * kOversampling},
                   {"open", open},
                   {"open_samples", settings.open_samples},
                   {"full", Json::array({full[0], full[1]})},
                   {"full_samples", setup.full_samples}};
    const std::string text = job.dump(2) + "\n", key = hashInputs(text, setup, settings);
    if (readBytes(prefix + "-cycles.key") != key)
    {
        HEARTH_TRY(writeText(prefix + "-cycles.json", text));
        std::vector<std::string> command = blenderCommand(settings, "render_scene.py");
        command.insert(command.end(), {"--", prefix + "-cycles.json"});
        HEARTH_TRY(runProgram(command));
        HEARTH_TRY(writeText(prefix + "-cycles.key", key));
    }
    ReferenceImages images;
    HEARTH_ASSIGN_OR_RETURN(images.open, readPfm(open));
    for (size_t half = 0; half < 2; ++half)
    {
        HEARTH_ASSIGN_OR_RETURN(images.full[half], readPfm(full[half]));
    }
    return images;
}

} // namespace hearth::picture
