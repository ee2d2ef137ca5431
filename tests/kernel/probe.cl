// SPDX-License-Identifier: MIT
// Kernels that return results of device functions to the tests. probe.c appends this file to clrt's
// kernels, whose source already includes all headers.

kernel void probe_layout(global uint *sizes)
{
    SphereData sphere;
    BvhPair pair;
    FrameData frame;
    TriangleData triangle;
    sizes[0] = sizeof(Material);
    sizes[1] = sizeof(PointLight);
    sizes[2] = sizeof(SphereData);
    sizes[3] = sizeof(TriangleData);
    sizes[4] = sizeof(CornerNormals);
    sizes[5] = sizeof(BvhPair);
    sizes[6] = sizeof(CameraData);
    sizes[7] = sizeof(FrameData);
    sizes[8] = (uint)((char *)&sphere.material - (char *)&sphere);
    sizes[9] = (uint)((char *)&pair.count - (char *)&pair);
    sizes[10] = (uint)((char *)&frame.uses_bvh - (char *)&frame);
    sizes[11] = (uint)((char *)&triangle.shading - (char *)&triangle);
    BvhWide wide;
    TriangleBlock block;
    TriangleLook look;
    sizes[12] = sizeof(BvhWide);
    sizes[13] = sizeof(TriangleBlock);
    sizes[14] = sizeof(TriangleLook);
    sizes[15] = (uint)((char *)&wide.child - (char *)&wide);
    sizes[16] = (uint)((char *)&wide.child_count - (char *)&wide);
    sizes[17] = (uint)((char *)&block.id - (char *)&block);
    sizes[18] = (uint)((char *)&look.shading - (char *)&look);
    CornerColors colors;
    sizes[19] = sizeof(CornerColors);
    sizes[20] = (uint)((char *)&colors.shading - (char *)&colors);
}

// Each case has eight floats: {normal, half vector, shininess, exponent as bits}.
kernel void probe_highlights(global const float *cases, global float *results)
{
    const uint item = get_global_id(0);
    global const float *values = cases + 8 * item;
    MaterialLanes material;
    material.shininess = values[6];
    material.exponent = as_uint(values[7]);
    results[item] = highlight(&material, load3(values), load3(values + 3));
}

// values holds pairs {base, exponent}. results receives each power twice, computed by squaring and
// by exponential().
kernel void probe_powers(global const Scalar *values, global Scalar *results)
{
    const uint item = get_global_id(0);
    const Scalar base = values[2 * item], exponent = values[2 * item + 1];
    results[2 * item] = integer_power(base, (uint)exponent);
    results[2 * item + 1] = exponential(exponent * log_one_plus(base - 1.0f));
}

// Each ray has six floats: {origin, direction}. There is one ray per sphere.
kernel void probe_spheres(global const SphereData *spheres, global const float *rays,
                          global Scalar *distances)
{
    const uint item = get_global_id(0);
    const Sphere sphere = sphere_at(&spheres[item]);
    distances[item] =
        sphere_distance(&sphere, load3(rays + 6 * item), load3(rays + 6 * item + 3), true);
}

kernel void probe_units(global const float *vectors, global float *results)
{
    const uint item = get_global_id(0);
    const Real3 unit = unit_vector(load3(vectors + 3 * item));
    vstore3((float3)(unit.x, unit.y, unit.z), item, results);
}

// Each case is a ratio of refractive indices and the incoming ray's cosine. The results are the
// refracted ray's cosine, the reflectance, one minus the reflectance, and the refracted direction.
// The normal is +z.
kernel void probe_refractions(global const float *cases, global float *results)
{
    const uint item = get_global_id(0);
    const float cosine = cases[2 * item + 1];
    const Refraction at = refraction_at(cases[2 * item], cosine);
    const Real3 viewer = real3_of(sqrt((1.0f - cosine) * (1.0f + cosine)), 0.0f, cosine);
    const Real3 direction = refracted_direction(&at, real3_of(0.0f, 0.0f, 1.0f), viewer);
    global float *result = results + 6 * item;
    result[0] = at.beyond;
    result[1] = at.reflectance;
    result[2] = 1.0f - at.reflectance;
    vstore3((float3)(direction.x, direction.y, direction.z), 1, result);
}
