// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/srgb.h"

#include <cmath>
#include <limits>

namespace hearth::textures
{

namespace
{

double linearFromSrgb(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

} // namespace

SrgbTables::SrgbTables()
{
    for (size_t i = 0; i < 256; ++i)
    {
        linear_[i] = static_cast<float>(linearFromSrgb(static_cast<double>(i) / 255));
        upper_[i] = static_cast<float>(linearFromSrgb((static_cast<double>(i) + 0.5) / 255));
    }
    upper_[255] = std::numeric_limits<float>::infinity();
    uint8_t value = 0;
    for (size_t bucket = 0; bucket < kBuckets; ++bucket)
    {
        const float start = static_cast<float>(bucket) / static_cast<float>(kBuckets);
        while (start >= upper_[value])
            ++value;
        first_of_bucket_[bucket] = value;
    }
}

const SrgbTables& SrgbTables::get()
{
    static const SrgbTables tables;
    return tables;
}

WideSrgbTable::WideSrgbTable()
{
    for (size_t i = 0; i < linear_.size(); ++i)
        linear_[i] = static_cast<float>(linearFromSrgb(static_cast<double>(i) / 65535));
}

const WideSrgbTable& WideSrgbTable::get()
{
    static const WideSrgbTable table;
    return table;
}

} // namespace hearth::textures
