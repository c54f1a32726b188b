// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/picture/radiance_image.h"

#include "formats/base/assert.h"
#include "formats/base/atomic_file.h"
#include "tests/reference/tracer/gltf_material.h"

#include <bit>
#include <cstdio>
#include <fstream>

namespace hearth::picture
{

using reference::Double3;

static_assert(std::endian::native == std::endian::little);

Result<RadianceImage> readPfm(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file)
        return Error{Issue::input_missing, path, "", ""};
    std::string magic;
    RadianceImage image;
    double scale = 0;
    file >> magic >> image.width >> image.height >> scale;
    file.get(); // one white space ends the header
    constexpr uint32_t kMaxSide = 16384;
    if (!file || magic != "PF" || scale >= 0 || image.width > kMaxSide || image.height > kMaxSide)
        return Error{Issue::image_malformed, path, "", "it is no little-endian colour PFM"};
    image.pixels.resize(size_t{image.width} * image.height);
    std::vector<float> row(size_t{3} * image.width);
    for (uint32_t y = image.height; y-- > 0;)
    {
        if (!file.read(reinterpret_cast<char*>(row.data()), static_cast<std::streamsize>(4 * row.size())))
            return Error{Issue::image_malformed, path, "", "it ends early"};
        for (size_t x = 0; x < image.width; ++x)
            image.pixels[size_t{y} * image.width + x] =
                Double3(Float3{row[3 * x], row[3 * x + 1], row[3 * x + 2]});
    }
    return image;
}

Status writePfm(const std::string& path, const RadianceImage& image)
{
    HEARTH_ASSIGN_OR_RETURN(AtomicFile file, AtomicFile::create(path));
    file.write("PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n");
    for (uint32_t y = image.height; y-- > 0;)
    {
        std::vector<float> row;
        for (size_t x = 0; x < image.width; ++x)
        {
            const Double3 pixel = image.pixels[size_t{y} * image.width + x];
            for (const double channel : {pixel.x, pixel.y, pixel.z})
                row.push_back(static_cast<float>(channel));
        }
        file.write(std::as_bytes(std::span(row)));
    }
    return file.finish();
}

RadianceImage average(const RadianceImage& a, const RadianceImage& b)
{
    HEARTH_ASSERT(a.width == b.width && a.height == b.height);
    RadianceImage mean = a;
    for (size_t i = 0; i < mean.pixels.size(); ++i)
        mean.pixels[i] = (a.pixels[i] + b.pixels[i]) * 0.5;
    return mean;
}

reference::Image develop(const RadianceImage& image, uint32_t oversampling)
{
    reference::Image shown(image.width / oversampling, image.height / oversampling);
    const auto encode = [](double linear)
    { return static_cast<uint8_t>(std::clamp(reference::srgbFromLinear(linear), 0.0, 1.0) * 255 + 0.5); };
    for (uint32_t y = 0; y < shown.height; ++y)
        for (uint32_t x = 0; x < shown.width; ++x)
        {
            Double3 sum;
            for (uint32_t i = 0; i < oversampling * oversampling; ++i)
            {
                const size_t row = y * oversampling + i / oversampling;
                const Double3 radiance =
                    image.pixels[row * image.width + x * oversampling + i % oversampling];
                sum += {reference::filmic(radiance.x), reference::filmic(radiance.y),
                        reference::filmic(radiance.z)};
            }
            sum = sum / (double{1} * oversampling * oversampling);
            uint8_t* const out = shown.at(x, y);
            out[0] = encode(sum.x);
            out[1] = encode(sum.y);
            out[2] = encode(sum.z);
        }
    return shown;
}

} // namespace hearth::picture
