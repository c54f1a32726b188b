// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/small_sources.h"

#include <array>
#include <cstring>

namespace hearth::test
{

std::string tgaImage(int grey)
{
    // uncompressed true colour, 2 x 2, 24 bits
    std::string bytes{"\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\30\0", 18};
    return bytes.append(12, static_cast<char>(grey));
}

void writeObj(const Sandbox& folder, const std::string& name, double height, int grey)
{
    const std::string top = std::to_string(height);
    folder.write(name + ".obj", "mtllib " + name + ".mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 1 " + top +
                                    " 0\nv 0 " + top + " 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n" +
                                    "f 1/1/1 2/2/1 3/3/1 4/4/1\n");
    folder.write(name + ".mtl", "newmtl m\nmap_Kd " + name + ".tga\n");
    folder.write(name + ".tga", tgaImage(grey));
}

void writeGltf(const Sandbox& folder, const std::string& name, float top)
{
    const std::array<float, 9> positions{0, 0, 0, 1, 0, 0, top, 1, 0};
    std::string bytes(sizeof(positions), '\0');
    std::memcpy(bytes.data(), positions.data(), bytes.size());
    folder.write(name + ".bin", bytes);
    folder.write(name + ".gltf",
                 R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
                 R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],)"
                 R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
                 R"("textures":[{"source":0}],"images":[{"uri":")" +
                     name + R"(.tga"}],"buffers":[{"uri":")" + name +
                     R"(.bin","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
                     R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
                     R"("min":[0,0,0],"max":[1,1,0]}]})");
}

} // namespace hearth::test
