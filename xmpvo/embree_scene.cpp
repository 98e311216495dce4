#include "xmpvo/embree_scene.h"

#include <algorithm>
#include <embree3/rtcore.h>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

namespace visorder::detail {

namespace {

void throw_if_failed(RTCDevice device, const char* what)
{
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE)
        return;
    if (error == RTC_ERROR_OUT_OF_MEMORY)
        throw std::bad_alloc();
    const char* words = error == RTC_ERROR_UNSUPPORTED_CPU    ? "it does not support this processor"
                        : error == RTC_ERROR_INVALID_ARGUMENT ? "invalid argument"
                                                              : "internal error";
    throw std::runtime_error(std::string("Embree failed to ") + what + ": " + words);
}

bool count_bytes(void* held, ssize_t bytes, bool)
{
    static_cast<std::atomic<std::ptrdiff_t>*>(held)->fetch_add(bytes, std::memory_order_relaxed);
    return true;
}

struct Geometry {
    explicit Geometry(RTCGeometry geometry) : handle(geometry) {}
    Geometry(const Geometry&) = delete;
    Geometry& operator=(const Geometry&) = delete;
    ~Geometry() { rtcReleaseGeometry(handle); }

    RTCGeometry handle;
};

template <class Element>
Element* new_buffer(RTCDevice device, const Geometry& geometry, RTCBufferType type, RTCFormat format, std::size_t count)
{
    void* const memory = rtcSetNewGeometryBuffer(geometry.handle, type, 0, format, sizeof(Element), count);
    throw_if_failed(device, "allocate a buffer");
    return static_cast<Element*>(memory);
}

// What Embree hands to `record`: its own part first.
struct Shot {
    RTCIntersectContext context;
    std::vector<RayHit>* hits; // of each ray
};

// Rejects every hit, so that the ray goes on to the next.
void record(const RTCFilterFunctionNArguments* arguments)
{
    const auto* shot = reinterpret_cast<const Shot*>(arguments->context);
    const unsigned int n = arguments->N;
    for (unsigned int i = 0; i < n; ++i)
        if (arguments->valid[i] != 0) {
            shot->hits[RTCRayN_id(arguments->ray, n, i)].push_back(
                {RTCRayN_tfar(arguments->ray, n, i), RTCHitN_primID(arguments->hit, n, i)});
            arguments->valid[i] = 0;
        }
}

} // namespace

void EmbreeScene::Release::operator()(RTCDeviceTy* device) const
{
    rtcReleaseDevice(device);
}

void EmbreeScene::Release::operator()(RTCSceneTy* scene) const
{
    rtcReleaseScene(scene);
}

EmbreeScene::EmbreeScene(const BoundarySurface& surface)
    : held_(std::make_unique<std::atomic<std::ptrdiff_t>>(0)), device_(rtcNewDevice(nullptr))
{
    if (!device_)
        throw_if_failed(nullptr, "start");
    RTCDevice device = device_.get();
    rtcSetDeviceMemoryMonitorFunction(device, count_bytes, held_.get());
    scene_.reset(rtcNewScene(device));
    throw_if_failed(device, "make a scene");
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);

    const Geometry geometry(
        rtcNewGeometry(device, surface.triangles ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_QUAD));
    throw_if_failed(device, "make a geometry");
    auto* const points =
        new_buffer<glm::vec3>(device, geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, surface.points.size());
    std::transform(surface.points.begin(), surface.points.end(), points,
                   [](const glm::dvec3& point) { return glm::vec3(point); });
    // A quadrilateral that repeats its last corner is a triangle to Embree too.
    const auto copy_corners = [&]<std::size_t count>(RTCFormat format) {
        using Corners = std::array<std::uint32_t, count>;
        auto* const faces = new_buffer<Corners>(device, geometry, RTC_BUFFER_TYPE_INDEX, format, surface.faces.size());
        for (std::size_t i = 0; i < surface.faces.size(); ++i)
            std::copy_n(surface.faces[i].begin(), count, faces[i].begin());
    };
    if (surface.triangles)
        copy_corners.template operator()<3>(RTC_FORMAT_UINT3);
    else
        copy_corners.template operator()<4>(RTC_FORMAT_UINT4);
    rtcSetGeometryIntersectFilterFunction(geometry.handle, record);
    rtcCommitGeometry(geometry.handle);
    rtcAttachGeometry(scene_.get(), geometry.handle);
    rtcCommitScene(scene_.get());
    throw_if_failed(device, "build the scene");
}

void EmbreeScene::shoot(std::span<const Ray> rays, std::array<std::vector<RayHit>, most_rays>& hits) const
{
    static_assert(most_rays == 4);
    Shot shot;
    rtcInitIntersectContext(&shot.context);
    shot.hits = hits.data();
    alignas(16) RTCRayHit4 packet{};
    alignas(16) std::array<int, 4> valid{};
    for (unsigned int i = 0; i < rays.size(); ++i) {
        const glm::vec3 origin(rays[i].origin), direction(rays[i].direction);
        valid[i] = -1;
        packet.ray.org_x[i] = origin.x;
        packet.ray.org_y[i] = origin.y;
        packet.ray.org_z[i] = origin.z;
        packet.ray.dir_x[i] = direction.x;
        packet.ray.dir_y[i] = direction.y;
        packet.ray.dir_z[i] = direction.z;
        packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
        packet.ray.mask[i] = ~0u;
        packet.ray.id[i] = i;
        packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        hits[i].clear();
    }
    rtcIntersect4(valid.data(), scene_.get(), &shot.context, &packet);
    // A ray through the diagonal of a quadrilateral may meet both of its halves.
    const auto ascending = [](const RayHit& a, const RayHit& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.face < b.face;
    };
    const auto same_face = [](const RayHit& a, const RayHit& b) { return a.face == b.face; };
    for (std::size_t i = 0; i < rays.size(); ++i) {
        std::sort(hits[i].begin(), hits[i].end(), ascending);
        hits[i].erase(std::unique(hits[i].begin(), hits[i].end(), same_face), hits[i].end());
    }
}

} // namespace visorder::detail
