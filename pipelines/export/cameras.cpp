// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/cameras.h"

namespace hearth::gltf_export
{

using namespace formats;

void addCameras(GltfDocument& document, const PackView& pack)
{
    for (const CameraRecord& record : pack.cameras())
    {
        Camera camera;
        camera.name = pack.text(record.name);
        camera.is_orthographic = record.type == static_cast<uint32_t>(CameraType::orthographic);
        camera.y_fov = double{record.y_fov_rad};
        camera.aspect = double{record.aspect};
        camera.x_magnification = double{record.x_magnification};
        camera.y_magnification = double{record.y_magnification};
        camera.z_near = double{record.z_near};
        camera.z_far = double{record.z_far};
        document.nodes[record.node].camera = static_cast<uint32_t>(document.cameras.size());
        document.cameras.push_back(std::move(camera));
    }
}

} // namespace hearth::gltf_export
