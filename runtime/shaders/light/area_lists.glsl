// Lists the ranged lights that reach an area of a frame, by one workgroup: it marks them, then each thread
// has 32 of the marks. Runs twice: to count, and to write the indices. Needs light_buffer.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/push_constants.h"
#include "runtime/shaders/cull/scan.glsl"

layout(local_size_x = kScanThreads) in;

layout(push_constant) uniform Push { LightListsPush push; };

shared uint marks[kMaxLights / 32u]; // as many as threads

// True if a light reaches the area of the workgroup.
bool reachesArea(CellLight light);

// Place of the light after `bits` of the marks of a thread; 0 if there is none.
uint nextMarked(uint thread, uint bits)
{
    while (bits == 0u && ++thread < kScanThreads)
        bits = marks[thread];
    return bits == 0u ? 0u : thread * 32u + uint(findLSB(bits));
}

// List the lights of an area. All threads must call it.
// word_at  of its list, which has a place where indices are written
void listArea(uint word_at)
{
    bool writes = push.writes != 0u;
    uint thread = gl_LocalInvocationIndex;
    uint listed = writes ? light_words[word_at] : 0u;
    if (writes && (lightCellCount(listed) == 0u || lightCellCount(listed) == kAllLights))
        return;
    marks[thread] = 0u;
    barrier();
    uint ranged = lightCount(kCountRanged);
    for (uint place = thread; place < ranged; place += kScanThreads)
        if (reachesArea(lightInView(place)))
            atomicOr(marks[place >> 5], 1u << (place & 31u));
    barrier();
    uint total;
    uint rank = exclusiveScan(uint(bitCount(marks[thread])), total);
    if (!writes)
    {
        if (thread == 0u)
            light_words[word_at] = total;
        return;
    }
    uint first_word = lighting.first_index_word + lightCellOffset(listed);
    for (uint bits = marks[thread]; bits != 0u; bits &= bits - 1u, ++rank)
        if ((rank & 1u) == 0u)
            light_words[first_word + (rank >> 1)] =
                (thread * 32u + uint(findLSB(bits))) | nextMarked(thread, bits & (bits - 1u)) << 16;
}
