// SPDX-License-Identifier: MIT
// Measured costs. A session uses them to choose kernels, and the window uses them to choose its
// first resolution. Wrong costs would change a picture's time, but never the picture.
//
// Each comment ends with the command that measures the cost again. "Trace" is the member
// seconds.trace of --json. Commands that measure compilation require an empty cache, for example
// XDG_CACHE_HOME=$(mktemp -d).
#pragma once

// Up to this number of triangles, wide kernels test all triangles instead of traversing a tree.
// With 8, 16, 32 and 64 triangles, packets take 0.92, 0.91, 0.95 and 1.06 times as long without a
// tree as with one.
// Measure: trace of `clrt SCENE --tune kernel=packet,bvh=none --repeat 50 --json`, divided by the
// trace with bvh=sah.
#define TREELESS_TRIANGLES 32

// The seconds to compile an uncached program.
// Measure: the time of `clrt warm SCENE --tune specialize=always`.
#define COMPILE_SECONDS 1.5

// The fraction of tracing time that specialization saves (0 to 7 % with packets).
// Measure: 1 - trace of `clrt SCENE --tune specialize=always --repeat 9 --json` / trace with
// specialize=never.
#define SPECIALIZED_SAVES 0.03

// The rays that one core traces per second in a scene of medium size, and the rays per sample.
// Measure: rays.total / trace / cores and rays.total / samples.total of `clrt SCENE --json`.
#define RAYS_PER_SECOND 3e6
#define RAYS_PER_SAMPLE 2.0

// The seconds to compile packets, and to compile quick kernels.
// Measure: "ready in" of `clrt SCENE --tune kernel=packet -v --hash`, and the same with
// kernel=pair.
#define PACKET_COMPILE_SECONDS 1.25
#define QUICK_COMPILE_SECONDS  0.8

// The core seconds per sample that packets save in comparison with pair kernels, in scenes with
// fewer than QUICK_TRIANGLES triangles. In larger scenes, packets save more.
// Measure: trace * cores / samples.total of `clrt SCENE --tune kernel=pair --repeat 9 --json`,
// minus the quotient with kernel=packet.
#define QUICK_TRIANGLES  20000
#define SAVED_PER_SAMPLE 0.3e-6

// The fraction of a time limit that quick kernels waste. They trace at most half as many samples as
// packets.
// Measure: 1 - samples.total of `clrt SCENE --time 1 --tune kernel=pair --json` / samples.total
// with kernel=packet.
#define LOST_OF_LIMIT 0.5

// A pixel refined toward the error E takes as long as 1 + ERROR_SAMPLES / E samples of --aa. One
// sample of refinement takes about as long as four samples of --aa.
// Measure: trace of `clrt SCENE --error E --repeat 9 --json`, divided by the trace with --aa=1.
#define ERROR_SAMPLES 0.08

// A pixel refined to the contrast T takes as long as 1 + CONTRAST_SAMPLES / sqrt(T) samples of
// --aa. The measured constant was 0.4 to 0.5 in a small scene, and 2.2 to 2.6 in a scene with a
// mesh.
// Measure: trace of `clrt SCENE --aa-adaptive=T --repeat 9 --json`, divided by the trace with
// --aa=1.
#define CONTRAST_SAMPLES 1

// The seconds per sample with a tree. Without a tree, each triangle adds TRIANGLE_GUESS seconds per
// sample. The window estimates its first picture's time from both.
// Measure: trace / samples.total of `clrt SCENE --json`, and the same with --tune bvh=none.
#define SAMPLE_GUESS   4e-7
#define TRIANGLE_GUESS 1e-9
