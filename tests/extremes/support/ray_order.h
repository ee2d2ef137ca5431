// SPDX-License-Identifier: MIT
// Orders rays so that those that can search as a packet follow each other.
#pragma once

#include "ray_batch.h"

// Fills places with the numbers 0 to count - 1, in such an order of the rays.
void ray_order(const TestRay *rays, size_t count, uint32_t *places);

// Returns the class that a packet's rays share: direction signs and longest axis.
uint32_t ray_order_class(const TestRay *ray);
