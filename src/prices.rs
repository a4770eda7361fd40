//! Prices, in sixteenths of a cycle of a core without wait states: made by `cargo xtask cost --calibrate`.

use crate::{price::Price, work::Work};

/// In the order of the counts of [`Work`].
impl Price {
    /// Cycles of a Cortex-M0+ for [`DuffBarycentric`](crate::DuffBarycentric).
    pub const M0_PLUS_DUFF_BARYCENTRIC: Self = Self(Work::of([
        9839, 4911, 2223, 6685, 0, 29120, 13906, 0, 413, 7484, 0, 8045, 18313, 60300, 1456, 35124, 0, 2184, 13652, 2462, 38, 986,
        2337, 3822, 253, 1785, 819, 2129,
    ]));

    /// Cycles of a Cortex-M0+ for [`QuadraticIntensity`](crate::QuadraticIntensity).
    pub const M0_PLUS_QUADRATIC_INTENSITY: Self = Self(Work::of([
        9839, 4712, 2223, 6751, 0, 29021, 14105, 0, 479, 7725, 0, 7964, 18422, 60117, 969, 45165, 0, 2530, 13845, 2222, 38, 0,
        3115, 1719, 379, 1220, 0, 0,
    ]));

    /// Cycles of a Cortex-M0+ for [`Gouraud`](crate::Gouraud).
    pub const M0_PLUS_GOURAUD: Self = Self(Work::of([
        9946, 3782, 2456, 7025, 0, 28852, 14946, 0, 753, 7709, 0, 8355, 18216, 61195, 25, 17490, 0, 2735, 13845, 1981, 38, 0,
        2035, 1448, 964, 0, 0, 0,
    ]));

    /// Cycles of a Cortex-M0+ for [`Flat`](crate::Flat).
    pub const M0_PLUS_FLAT: Self = Self(Work::of([
        9946, 3936, 2408, 6977, 0, 28884, 14821, 0, 705, 7377, 0, 8398, 17872, 60462, 0, 11759, 0, 2569, 13845, 2147, 38, 0,
        1129, 1685, 549, 0, 0, 0,
    ]));

    /// The same for each rung of [`Degrading`](crate::Degrading).
    pub const M0_PLUS_DEGRADING: [Self; 4] = [
        Self(Work::of([
            9839, 5233, 2223, 6685, 0, 29004, 13673, 0, 413, 7375, 0, 8082, 17566, 59230, 3435, 38349, 484, 2677, 13570, 2092,
            38, 828, 3263, 4340, 254, 1720, 831, 2129,
        ])),
        Self(Work::of([
            9839, 5233, 2223, 6685, 0, 29004, 13673, 0, 413, 7598, 0, 7957, 17266, 59401, 3755, 52452, 269, 2618, 13570, 2152,
            38, 158, 3300, 3627, 274, 1100, 0, 0,
        ])),
        Self(Work::of([
            9839, 4911, 2223, 6792, 0, 28843, 13996, 0, 520, 7206, 0, 8290, 17511, 60188, 3633, 26612, 233, 2668, 13570, 2102,
            38, 0, 2927, 3554, 934, 0, 0, 0,
        ])),
        Self(Work::of([
            9839, 4911, 2223, 6792, 0, 28843, 15210, 0, 520, 7146, 0, 8330, 17521, 59880, 3389, 21415, 54, 2435, 13570, 2335, 38,
            0, 2657, 4271, 171, 0, 0, 0,
        ])),
    ];

    /// Cycles of a Cortex-M4 for [`DuffBarycentric`](crate::DuffBarycentric).
    pub const M4_DUFF_BARYCENTRIC: Self = Self(Work::of([
        7276, 4534, 1595, 4785, 0, 20483, 742, 0, 413, 5663, 0, 6049, 7881, 19650, 633, 22436, 0, 2197, 1367, 1934, 21, 472,
        2125, 3044, 164, 1093, 374, 1865,
    ]));

    /// Cycles of a Cortex-M4 for [`QuadraticIntensity`](crate::QuadraticIntensity).
    pub const M4_QUADRATIC_INTENSITY: Self = Self(Work::of([
        7258, 4534, 1595, 4785, 0, 20483, 868, 0, 413, 5755, 0, 5984, 7867, 19550, 996, 30169, 0, 2632, 1241, 1605, 21, 251,
        1768, 1365, 221, 657, 0, 0,
    ]));

    /// Cycles of a Cortex-M4 for [`Gouraud`](crate::Gouraud).
    pub const M4_GOURAUD: Self = Self(Work::of([
        7294, 4570, 1595, 4797, 0, 20447, 1481, 0, 425, 5675, 0, 6130, 7818, 19568, 0, 12748, 0, 2214, 1244, 1653, 21, 190, 1232,
        1238, 527, 0, 0, 0,
    ]));

    /// Cycles of a Cortex-M4 for [`Flat`](crate::Flat).
    pub const M4_FLAT: Self = Self(Work::of([
        7294, 6281, 0, 4758, 1595, 18969, 1612, 0, 386, 5636, 0, 6130, 7759, 19569, 0, 7957, 0, 2138, 1303, 1799, 21, 215, 792,
        1171, 445, 0, 0, 0,
    ]));

    /// The same for each rung of [`Degrading`](crate::Degrading).
    pub const M4_DEGRADING: [Self; 4] = [
        Self(Work::of([
            7258, 6237, 0, 4827, 1595, 18763, 1216, 0, 454, 5562, 0, 6097, 7803, 19530, 2667, 28272, 0, 2076, 1279, 1985, 21,
            276, 3189, 3902, 162, 1024, 372, 1865,
        ])),
        Self(Work::of([
            7258, 4915, 1595, 4736, 0, 20631, 829, 0, 363, 5743, 0, 5953, 7673, 19439, 3126, 37178, 0, 2258, 1296, 1803, 21, 0,
            2879, 3287, 185, 685, 0, 0,
        ])),
        Self(Work::of([
            7258, 4642, 1595, 4827, 0, 20358, 1440, 0, 454, 5705, 0, 6123, 7790, 19459, 2928, 19476, 179, 2341, 1279, 1720, 21,
            0, 2687, 3246, 556, 0, 0, 0,
        ])),
        Self(Work::of([
            7258, 4642, 1595, 4827, 0, 20358, 1650, 0, 454, 5705, 0, 6136, 7784, 19459, 2930, 15076, 101, 2476, 1313, 1585, 21,
            0, 2526, 3466, 136, 0, 0, 0,
        ])),
    ];
}
