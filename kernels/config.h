// SPDX-License-Identifier: MIT
// The switches a program is specialized by, each a constant that plain `if`s test: all code stays
// compiled and the optimizer removes what a scene lacks.  The defaults make the general program,
// which renders every scene.  host/accel/traits.c sets them.
#ifndef CLRT_CONFIG_H
#define CLRT_CONFIG_H

#ifndef CLRT_SPHERES
#define CLRT_SPHERES 1 // the scene has spheres
#endif
#ifndef CLRT_TRIANGLES
#define CLRT_TRIANGLES 1 // the scene has triangles
#endif
#ifndef CLRT_BVH
#define CLRT_BVH 1 // triangles are found through a tree (0: each is tested)
#endif
#ifndef CLRT_MIRRORS
#define CLRT_MIRRORS 1 // some material reflects
#endif
#ifndef CLRT_SHADED
#define CLRT_SHADED 1 // some material is shaded by lights
#endif
#ifndef CLRT_STATISTICS
#define CLRT_STATISTICS 0 // rays and tests are counted
#endif

// Choices of the user's, which host/device/kernel_choice.c sets.
#ifndef CLRT_WIDE_NODES
#define CLRT_WIDE_NODES 0 // BvhWide and TriangleBlock take the places of BvhPair and TriangleData
#endif
#ifndef CLRT_PACKET
#define CLRT_PACKET 0 // a work-item renders a block of pixels
#endif
#ifndef CLRT_SIGNATURES
#define CLRT_SIGNATURES 0 // samples are told apart by what they saw
#endif
#ifndef CLRT_FP64
#define CLRT_FP64 0 // Real is a double: one ray a work-item, through nodes of two children
#endif

#endif
