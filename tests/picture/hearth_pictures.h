// Makes a scene's source, cooks it, and draws it with Hearth in all settings.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/picture/comparison.h"

namespace hearth::picture
{

class HearthPictures
{
public:
    /// assets  folder of real assets
    /// work    folder of all files that are made
    HearthPictures(const Scene& scene, const std::string& assets, const std::string& work);

    /// Generate the source of a sample, and cook both packs. errors: child_failed.
    Status cook() const;

    const std::string& source() const { return source_; }
    /// Return the path of the pack that a setting draws.
    std::string packPath(Setting setting) const;

    /// Draw the scene in a setting. errors: child_failed; as for reading images.
    /// camera  of scenes without one of their own
    Result<reference::Image> draw(Setting setting, const shared::Camera& camera) const;

    /// Draw the baked ambient occlusion at the centres of pixels. errors: the same.
    Result<reference::Image> drawOcclusion(const shared::Camera& camera) const;

private:
    Status cook(Setting setting, const std::vector<std::string>& options) const;
    Result<reference::Image> draw(Setting setting, const shared::Camera& camera, const std::string& image,
                                  const std::vector<std::string>& options) const;

    const Scene& scene_;
    std::string prefix_, source_, cache_;
};

} // namespace hearth::picture
