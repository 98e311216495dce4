#include "tests/fuzz/seeds.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace visorder::tests {

namespace {

template <class T>
void append(std::string& bytes, T value)
{
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    bytes.append(raw.data(), raw.size());
}

constexpr std::array<std::int32_t, 3> plot3d_size{3, 2, 2};
constexpr int plot3d_points = 12;

std::string plot3d_grid()
{
    std::string bytes;
    for (const std::int32_t n : plot3d_size)
        append(bytes, n);
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < plot3d_points; ++i)
            append(bytes, static_cast<float>(axis == 0 ? i % 3 : axis == 1 ? i / 3 % 2 : i / 6));
    return bytes;
}

std::string plot3d_solution()
{
    std::string bytes;
    for (const std::int32_t n : plot3d_size)
        append(bytes, n);
    for (int i = 0; i < 4 + 5 * plot3d_points; ++i)
        append(bytes, static_cast<float>(i));
    return bytes;
}

} // namespace

std::vector<Seed> own_seeds()
{
    return {
        {"polygons.obj",
         "# a cube\nmtllib a.mtl\no cube\nv 0 0 0\nv 1 0 0\nv 1 1 0 0.5\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\n"
         "v 0 1 1\nvt 0 0\nvn 0 0 1\ng side\nusemtl red\ns off\nf 4 3 2 1\nf 5/1 6/1 7/1 8/1\n"
         "f 1//1 2//1 6//1 5//1\nf -8/1/1 -7/1/1 -3/1/1\nf 2 3 7 \\\n6\nf 3 4 8 7\nl 1 2 3\np 1\n"},
        {"concave.obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\n"},
        {"gridxyz.bin", plot3d_grid()},
        {"gridq.bin", plot3d_solution()},
        {"own.json", R"({"points": [{"scalar": 0.0, "extinction": 0.5, "colour": [0.1, 0.2, 0.8]},
{"scalar": 1.0, "extinction": 2, "colour": [1, 0, 0]}]})"},
        {"paraview.json", R"([{"ColorSpace": "Diverging", "Name": "Cool to Warm", "NanColor": [1, 1, 0],
"Points": [0, 0.25, 0.5, 0, 1, 0.75, 0.5, 0], "RGBPoints": [0, 0.23, 0.3, 0.75, 0.5, 0.86, 0.86, 0.86, 1, 0.7, 0, 0.15]},
{"Name": "Other", "RGBPoints": [-1, 0, 0, 0, 1, 1, 1, 1]}])"},
        {"order.txt", "3\n0\n2\n1\n"},
        {"order.npy", std::string("\x93NUMPY\x01\x00\x46\x00", 10) +
                          "{'descr': '<u4', 'fortran_order': False, 'shape': (3,), }            \n" +
                          std::string("\0\0\0\0\2\0\0\0\1\0\0\0", 12)},
    };
}

} // namespace visorder::tests
