// SPDX-License-Identifier: MIT
// Measured costs by which a session chooses kernels, and the window its first resolution. Other
// machines have other costs. They change only the time that a picture takes, never the picture. The
// commands measure the costs again; "trace" is the member seconds.trace of --json. Commands for
// compiling need an empty cache, such as XDG_CACHE_HOME=$(mktemp -d).
#pragma once

// Up to this number of triangles, wide kernels test all triangles instead of traversing a tree.
// With 8, 16, 32 and 64 triangles, packets take 0.92, 0.91, 0.95 and 1.06 times as long without a
// tree as with one.
// Trace of `clrt SCENE --tune kernel=packet,bvh=none --repeat 50 --json`, and of bvh=sah.
#define TREELESS_TRIANGLES 32

// The seconds to compile an uncached program: `clrt warm SCENE --tune specialize=always`.
#define COMPILE_SECONDS 1.5

// The fraction of tracing time that specialization saves (0 to 7 % with packets).
// Trace of `clrt SCENE --tune specialize=always --repeat 9 --json`, and of specialize=never.
#define SPECIALIZED_SAVES 0.03

// One core's rate in a medium scene: rays.total / trace / cores of `clrt SCENE --json`, and rays
// per sample: rays.total / samples.total.
#define RAYS_PER_SECOND 3e6
#define RAYS_PER_SAMPLE 2.0

// The seconds to compile packets and quick kernels: "ready in" of `clrt SCENE --tune kernel=packet
// -v --hash`, and of kernel=pair, minus about half a second that opening the device takes.
#define PACKET_COMPILE_SECONDS 1.25
#define QUICK_COMPILE_SECONDS  0.8

// The core seconds that packets save per sample in scenes with fewer than QUICK_TRIANGLES
// triangles. In larger scenes, they save more. Trace * cores / samples.total of `clrt SCENE --tune
// kernel=pair --repeat 9 --json`, minus that of kernel=packet.
#define QUICK_TRIANGLES  20000
#define SAVED_PER_SAMPLE 0.3e-6

// The fraction of a time limit that the quick kernels lose, because they take at most half as many
// samples in that time.
// The ratio of samples.total of `clrt SCENE --time 1 --tune kernel=pair --json` and kernel=packet.
#define LOST_OF_LIMIT 0.5

// The work of a pixel toward an error E is 1 + ERROR_SAMPLES / E samples of --aa, because each
// sample that it takes costs about as much as four samples of --aa.
// Trace of `clrt SCENE --error E --repeat 9 --json`, divided by that of --aa=1.
#define ERROR_SAMPLES 0.08

// The work of a pixel toward a contrast T is 1 + CONTRAST_SAMPLES / sqrt(T) samples of --aa. The
// constant is 0.4 to 0.5 in a small scene, and 2.2 to 2.6 with a mesh.
// Trace of `clrt SCENE --aa-adaptive=T --repeat 9 --json`, divided by that of --aa=1.
#define CONTRAST_SAMPLES 1

// The seconds per sample with a tree, and the additional seconds per sample and triangle without
// one. The window guesses with them until it has measured its first picture.
// Trace / samples.total of `clrt SCENE --json`, and of --tune bvh=none.
#define SAMPLE_GUESS   4e-7
#define TRIANGLE_GUESS 1e-9
