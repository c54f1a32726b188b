// Computes a word for each invocation by ways that depend on specialization constants: branches, switches,
// early returns, loops that end early, never repeat or never end by themselves, and values of several ways.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450

layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kMode = 1u;
layout(constant_id = 1) const bool kSums = false;
layout(constant_id = 2) const uint kCount = 3u;
layout(constant_id = 3) const int kOffset = -2;
layout(constant_id = 4) const float kScale = 1.5;
layout(constant_id = 5) const uint kMask = 0u;
const bool kOddMode = (kMode & 1u) == 1u;
const uint kShifted = (kMask << 2u) | kMode;

layout(set = 0, binding = 0, std430) writeonly buffer Results { uint results[]; };

uint hash(uint x) { return (x ^ x >> 13u) * 0x9E3779B1u; }

// Leaves by several returns, some of them within constructs.
uint returnEarly(uint x)
{
    if (kSums && kMask == 0u)
        return x + 11u;
    for (uint i = 0u; i < 5u; ++i)
    {
        if (i == kCount)
            return x * i;
        if ((hash(x + i) & 7u) == 0u)
            return x + i;
    }
    if (kOddMode)
        return x - 1u;
    return hash(x);
}

uint chooseByConstant(uint x)
{
    switch (kMode)
    {
    case 0u:
        x += 5u;
        if ((x & 1u) != 0u)
            break;
        x ^= 77u;
        break;
    case 1u:
        x *= 3u; // falls through
    case 2u:
        if (x > 1000u)
            return x;
        x = hash(x);
        break;
    default:
        x = kShifted > 9u ? hash(x + 1u) : x + kShifted;
    }
    return x;
}

uint loop(uint x)
{
    uint sum = 0u;
    for (uint i = 0u; i < kCount; ++i)
    {
        if (kMask != 0u)
        {
            if ((hash(i + x) & kMask) != 0u)
                continue;
            sum += 3u;
        }
        uint j = 0u;
        while (true)
        {
            sum += kSums ? j : 1u;
            if (++j > (x & 3u) || !kOddMode)
                break;
        }
        if (kMode == 3u)
            break;
    }
    do
    {
        sum ^= x;
        if (kMode == 2u)
            break;
        sum += 1u;
    } while (false);
    return sum;
}

float compute(uint x)
{
    float value = float(int(x & 255u) + kOffset) * kScale;
    bool both = kSums && value > 20.0;
    bool either = !kOddMode || value < 3.0;
    if (both || either)
        value = sqrt(abs(value)) + (both ? 1.0 : 0.25);
    return kOffset < 0 ? value : -value;
}

void main()
{
    uint x = hash(gl_GlobalInvocationID.x + 1u);
    uint word = returnEarly(x);
    word = hash(word) + chooseByConstant(x);
    word = hash(word) + loop(x);
    results[gl_GlobalInvocationID.x] = hash(word) ^ floatBitsToUint(compute(x));
}
