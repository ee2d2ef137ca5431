// SPDX-License-Identifier: MIT
// Measured costs by which a session chooses kernels. Other machines have other costs. They change
// only the time that a picture takes, never the picture.
#pragma once

// Up to this number of triangles, wide kernels test all triangles instead of traversing a tree.
// With 8, 16, 32 and 64 triangles, packets take 0.92, 0.91, 0.95 and 1.06 times as long without a
// tree as with one.
#define TREELESS_TRIANGLES 32

// The seconds to compile an uncached program, and the fraction of tracing time that specialization
// saves (0 to 7 % with packets). RAYS_PER_SECOND is one core's rate in a medium scene.
#define COMPILE_SECONDS   1.5
#define SPECIALIZED_SAVES 0.03
#define RAYS_PER_SECOND   3e6
#define RAYS_PER_SAMPLE   2.0

// The seconds to compile packets and quick kernels, and the core seconds that packets save per
// sample in scenes with fewer than QUICK_TRIANGLES triangles. In larger scenes, they save more.
#define PACKET_COMPILE_SECONDS 1.25
#define QUICK_COMPILE_SECONDS  0.8
#define QUICK_TRIANGLES        20000
#define SAVED_PER_SAMPLE       0.3e-6

// The fraction of a time limit that the quick kernels lose, because they take at most half as many
// samples in that time.
#define LOST_OF_LIMIT 0.5
