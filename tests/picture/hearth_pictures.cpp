// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/picture/hearth_pictures.h"

#include "cook/tools/child_processes.h"
#include "runtime/viewer/camera_path.h"
#include "tests/picture/programs.h"

namespace hearth::picture
{

namespace
{

std::string findProgram(const char* name)
{
    return tools::programFolder() + "/" + name;
}

} // namespace

HearthPictures::HearthPictures(const Scene& scene, const std::string& assets, const std::string& work)
    : scene_(scene),
      prefix_(work + "/" + std::string(scene.name)),
      source_(scene.source == Source::asset ? assets + "/" + std::string(scene.path) : prefix_ + ".glb"),
      cache_("dir:" + work + "/cache")
{
}

Status HearthPictures::cook() const
{
    if (scene_.source == Source::sample)
        HEARTH_TRY(runProgram({findProgram("hearth-samples"), std::string(scene_.path), "--texture-size",
                               "1024", "-o", source_}));
    HEARTH_TRY(cook(Setting::plain, {}));
    return cook(Setting::full, {"--visibility", "--bricks"});
}

Status HearthPictures::cook(Setting setting, const std::vector<std::string>& options) const
{
    std::vector<std::string> command{findProgram("hearth"), "cook",    "-q",  source_, "-o",
                                     packPath(setting),     "--cache", cache_};
    command.insert(command.end(), options.begin(), options.end());
    return runProgram(command);
}

std::string HearthPictures::packPath(Setting setting) const
{
    return prefix_ + (setting == Setting::full ? "-full.hearth" : ".hearth");
}

Result<reference::Image> HearthPictures::draw(Setting setting, const shared::Camera& camera) const
{
    std::vector<std::string> options{"--samples", "4"};
    if (setting == Setting::open)
        options.insert(options.end(), {"--shadows", "off", "--gi", "off", "--ambient-occlusion", "off",
                                       "--specular-occlusion", "off"});
    return draw(setting, camera, prefix_ + "-hearth-" + std::to_string(static_cast<int>(setting)) + ".png",
                options);
}

Result<reference::Image> HearthPictures::drawOcclusion(const shared::Camera& camera) const
{
    return draw(Setting::full, camera, prefix_ + "-occlusion.png", {"--samples", "1", "--view", "ao"});
}

Result<reference::Image> HearthPictures::draw(Setting setting, const shared::Camera& camera,
                                              const std::string& image,
                                              const std::vector<std::string>& options) const
{
    const std::string size = std::to_string(kWidth) + "x" + std::to_string(kHeight);
    std::vector<std::string> command{
        findProgram("hearth-render"), packPath(setting), "-o", image, "--size", size};
    command.insert(command.end(), options.begin(), options.end());
    if (scene_.view == View::first)
        command.insert(command.end(), {"--scene-camera", "0"});
    else
        command.insert(command.end(), {"--camera", viewer::formatCamera(camera)});
    HEARTH_TRY(runProgram(command));
    return reference::readPng(image);
}

} // namespace hearth::picture
