#pragma once

#include <array>
#include <cstddef>

namespace gaitmill {

/// ARK4(3)6L[2]SA of Kennedy & Carpenter (2003), Appl Numer Math 44:139-181: one set of weights for
/// an explicit method (bodies) and an L-stable, stiffly accurate implicit one (fibers, whose time
/// constants of 0.3 to 5 ms would otherwise dictate the step). Order 4 with an embedded order 3;
/// the first stage of the implicit method is explicit too.
namespace ark {

inline constexpr std::size_t kStages = 6;
inline constexpr double kGamma = 0.25;  ///< diagonal of the implicit method

using Row = std::array<double, kStages>;

inline constexpr Row kNodes = {0, 1. / 2, 83. / 250, 31. / 50, 17. / 20, 1};

inline constexpr Row kWeights = {
    82889. / 524892, 0, 15625. / 83664, 69875. / 102672, -2260. / 8211, 1. / 4};

/// Weights of order 3.
inline constexpr Row kEmbedded = {4586570599. / 29645900160,
                                  0,
                                  178811875. / 945068544,
                                  814220225. / 1159782912,
                                  -3700637. / 11593932,
                                  61727. / 225920};

inline constexpr std::array<Row, kStages> kExplicit = {
    Row{0, 0, 0, 0, 0, 0},
    Row{1. / 2, 0, 0, 0, 0, 0},
    Row{13861. / 62500, 6889. / 62500, 0, 0, 0, 0},
    Row{-116923316275. / 2393684061468,
        -2731218467317. / 15368042101831,
        9408046702089. / 11113171139209,
        0,
        0,
        0},
    Row{-451086348788. / 2902428689909,
        -2682348792572. / 7519795681897,
        12662868775082. / 11960479115383,
        3355817975965. / 11060851509271,
        0,
        0},
    Row{647845179188. / 3216320057751,
        73281519250. / 8382639484533,
        552539513391. / 3454668386233,
        3354512671639. / 8306763924573,
        4040. / 17871,
        0}};

inline constexpr std::array<Row, kStages> kImplicit = {
    Row{0, 0, 0, 0, 0, 0},
    Row{1. / 4, 1. / 4, 0, 0, 0, 0},
    Row{8611. / 62500, -1743. / 31250, 1. / 4, 0, 0, 0},
    Row{5012029. / 34652500, -654441. / 2922500, 174375. / 388108, 1. / 4, 0, 0},
    Row{15267082809. / 155376265600,
        -71443401. / 120774400,
        730878875. / 902184768,
        2285395. / 8070912,
        1. / 4,
        0},
    kWeights};

}  // namespace ark

}  // namespace gaitmill
