// Embree 3 and 4 under one set of names. Only for the .cpp files over Embree.
#pragma once

#if GRIDREEL_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace gridreel::traversal::embree {

#if GRIDREEL_EMBREE == 4

using Context = RTCRayQueryContext;

inline constexpr RTCSceneFlags filter_in_query = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

/// What goes with a call: whether rays are neighbours, a filter, and the context that the filter sees.
struct Query {
    Query(Context& context, bool coherent, RTCFilterFunctionN filter) {
        rtcInitRayQueryContext(&context);
        rtcInitIntersectArguments(&closest);
        rtcInitOccludedArguments(&any);
        int flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
        if (filter != nullptr) flags |= RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
        closest.flags = any.flags = static_cast<RTCRayQueryFlags>(flags);
        closest.filter = any.filter = filter;
        closest.context = any.context = &context;
    }

    RTCIntersectArguments closest;
    RTCOccludedArguments any;
};

inline void intersect(RTCScene scene, Query& query, RTCRayHit& ray) {
    rtcIntersect1(scene, &ray, &query.closest);
}
inline void intersect(RTCScene scene, Query& query, RTCRayHit16& rays, const int* valid) {
    rtcIntersect16(valid, scene, &rays, &query.closest);
}
inline void occluded(RTCScene scene, Query& query, RTCRay& ray) {
    rtcOccluded1(scene, &ray, &query.any);
}
inline void occluded(RTCScene scene, Query& query, RTCRay16& rays, const int* valid) {
    rtcOccluded16(valid, scene, &rays, &query.any);
}

#else

using Context = RTCIntersectContext;

inline constexpr RTCSceneFlags filter_in_query = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

/// What goes with a call: whether rays are neighbours, a filter, and the context that the filter sees.
struct Query {
    Query(Context& seen, bool coherent, RTCFilterFunctionN filter) : context(seen) {
        rtcInitIntersectContext(&context);
        context.flags =
            coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        context.filter = filter;
    }

    Context& context;
};

inline void intersect(RTCScene scene, Query& query, RTCRayHit& ray) {
    rtcIntersect1(scene, &query.context, &ray);
}
inline void intersect(RTCScene scene, Query& query, RTCRayHit16& rays, const int* valid) {
    rtcIntersect16(valid, scene, &query.context, &rays);
}
inline void occluded(RTCScene scene, Query& query, RTCRay& ray) {
    rtcOccluded1(scene, &query.context, &ray);
}
inline void occluded(RTCScene scene, Query& query, RTCRay16& rays, const int* valid) {
    rtcOccluded16(valid, scene, &query.context, &rays);
}

#endif

}  // namespace gridreel::traversal::embree
