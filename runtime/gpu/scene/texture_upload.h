// Uploads the images of a pack as textures.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"
#include "runtime/gpu/scene/scene_shading.h"

#include <span>

namespace hearth::gpu
{

/// Return for each image true if a material reads it.
std::vector<bool> findUsedImages(const formats::PackView& pack);

/// Fill Scene::images, but for streamed ones: the images that materials use, and behind them a white one for
/// textures that a material lacks. Formats that the device cannot sample are decoded: plain ones always,
/// compressed ones if the scene's options say so; Scene::decoded_textures counts them, and the caller is
/// warned once.
/// errors: texture_format, device_limit; those of PackView::imageData and of memory
Status uploadTextures(const Device& device, const formats::PackView& pack, Uploader& uploader, Scene& scene);

} // namespace hearth::gpu
