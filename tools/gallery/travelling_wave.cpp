#include "tools/gallery/travelling_wave.h"

#include "tools/gallery/packing.h"
#include "tools/gallery/turns.h"

#include <vector>

namespace gridreel::gallery {

void add_wave_weights(Document& document, Id node, std::span<const int> cycles, double duration_s, int keys) {
    std::vector<float> times, values;
    for (int key = 0; key <= keys; ++key) {
        const double part = double(key) / double(keys);
        times.push_back(static_cast<float>(part * duration_s));

        // In-tangents, values, out-tangents; tangents per second (glTF 2.0, appendix C.5).
        std::vector<float> weights, slopes;
        for (const int n : cycles) {
            const double turn = part * double(n);
            const double speed = 6.283185307179586 * double(n) / duration_s;
            weights.push_back(static_cast<float>(cos_turns(turn)));
            weights.push_back(static_cast<float>(sin_turns(turn)));
            slopes.push_back(static_cast<float>(-speed * sin_turns(turn)));
            slopes.push_back(static_cast<float>(speed * cos_turns(turn)));
        }
        values.insert(values.end(), slopes.begin(), slopes.end());
        values.insert(values.end(), weights.begin(), weights.end());
        values.insert(values.end(), slopes.begin(), slopes.end());
    }
    document.channels.push_back({.node = node,
                                 .path = Path::weights,
                                 .times = add_times(document, times),
                                 .values = add_scalars(document, values),
                                 .interpolation = Interpolation::cubic_spline});
}

}  // namespace gridreel::gallery
