//! Prices, in sixteenths of a cycle of a core without wait states: made by `cargo xtask cost --calibrate`.

use crate::{price::Price, work::Work};

/// In the order of the counts of [`Work`].
impl Price {
    /// Cycles of a Cortex-M0+ for [`DuffBarycentric`](crate::DuffBarycentric).
    pub const M0_PLUS_DUFF_BARYCENTRIC: Self = Self(Work::of([
        9785, 6040, 0, 5359, 2151, 17275, 17490, 0, 628, 8199, 0, 5771, 18542, 57213, 1042, 32902, 0, 2451, 13569, 1901, 38, 736,
        3212, 3703, 239, 1930, 1003, 2154,
    ]));

    /// Cycles of a Cortex-M0+ for [`QuadraticIntensity`](crate::QuadraticIntensity).
    pub const M0_PLUS_QUADRATIC_INTENSITY: Self = Self(Work::of([
        9785, 3800, 2151, 5359, 0, 19426, 17580, 0, 628, 8417, 0, 5763, 18490, 55730, 1236, 42865, 0, 2291, 13776, 2095, 38, 163,
        2559, 1634, 367, 1114, 0, 0,
    ]));

    /// Cycles of a Cortex-M0+ for [`Gouraud`](crate::Gouraud).
    pub const M0_PLUS_GOURAUD: Self = Self(Work::of([
        9713, 3352, 2151, 5359, 0, 18960, 17437, 0, 744, 7916, 0, 6053, 18605, 57794, 0, 17213, 0, 2606, 13776, 1884, 38, 47,
        2030, 1447, 860, 0, 0, 0,
    ]));

    /// Cycles of a Cortex-M0+ for [`Flat`](crate::Flat).
    pub const M0_PLUS_FLAT: Self = Self(Work::of([
        9713, 5717, 0, 5359, 2151, 17275, 17688, 0, 628, 8090, 0, 6023, 18130, 57328, 188, 11559, 0, 1983, 13776, 2369, 38, 214,
        683, 1488, 91, 0, 0, 0,
    ]));

    /// The same for each rung of [`Degrading`](crate::Degrading).
    pub const M0_PLUS_DEGRADING: [Self; 4] = [
        Self(Work::of([
            9785, 4355, 2151, 5359, 0, 19426, 17401, 0, 628, 7946, 0, 5784, 17464, 56013, 807, 34794, 721, 2457, 13569, 1912, 38,
            498, 3854, 4312, 236, 1870, 1007, 2115,
        ])),
        Self(Work::of([
            9785, 4355, 2151, 5359, 0, 19426, 17401, 0, 628, 8278, 0, 5646, 17325, 56113, 1442, 48766, 465, 2469, 13569, 1901,
            38, 100, 3483, 3424, 261, 1197, 0, 0,
        ])),
        Self(Work::of([
            9785, 4355, 2151, 5359, 0, 19426, 17401, 0, 628, 7833, 0, 5943, 17399, 56602, 1257, 24902, 402, 2572, 13569, 1797,
            38, 0, 2746, 3449, 954, 0, 0, 0,
        ])),
        Self(Work::of([
            9785, 6505, 0, 5359, 2151, 17275, 17401, 0, 628, 7800, 0, 5965, 17405, 56363, 1476, 20309, 207, 2360, 13569, 2009,
            38, 0, 1896, 3787, 40, 0, 0, 0,
        ])),
    ];

    /// Cycles of a Cortex-M4 for [`DuffBarycentric`](crate::DuffBarycentric).
    pub const M4_DUFF_BARYCENTRIC: Self = Self(Work::of([
        7240, 5376, 0, 3746, 1416, 11828, 2430, 0, 628, 5986, 0, 3861, 8038, 18059, 753, 22150, 0, 1841, 1383, 1754, 20, 666,
        2489, 2738, 160, 1109, 498, 1778,
    ]));

    /// Cycles of a Cortex-M4 for [`QuadraticIntensity`](crate::QuadraticIntensity).
    pub const M4_QUADRATIC_INTENSITY: Self = Self(Work::of([
        7240, 3687, 1480, 3810, 0, 13115, 2099, 0, 692, 6258, 0, 3817, 8093, 17959, 75, 29435, 0, 2377, 1250, 1615, 20, 67, 2304,
        1381, 197, 775, 0, 0,
    ]));

    /// Cycles of a Cortex-M4 for [`Gouraud`](crate::Gouraud).
    pub const M4_GOURAUD: Self = Self(Work::of([
        7168, 5072, 0, 3847, 1518, 11523, 3449, 0, 729, 5773, 0, 4011, 8111, 18188, 0, 11394, 0, 2290, 1314, 1564, 20, 138, 1721,
        1209, 547, 0, 0, 0,
    ]));

    /// Cycles of a Cortex-M4 for [`Flat`](crate::Flat).
    pub const M4_FLAT: Self = Self(Work::of([
        7168, 3782, 1443, 3773, 0, 13190, 3351, 0, 655, 5727, 0, 4005, 8038, 18229, 0, 6175, 0, 1896, 1348, 1993, 20, 23, 967,
        1079, 76, 0, 0, 0,
    ]));

    /// The same for each rung of [`Degrading`](crate::Degrading).
    pub const M4_DEGRADING: [Self; 4] = [
        Self(Work::of([
            7294, 5708, 0, 3755, 1425, 11801, 2978, 0, 637, 6004, 0, 3830, 7807, 17808, 780, 27391, 45, 1846, 1348, 1749, 20,
            651, 3094, 3467, 160, 1103, 498, 1778,
        ])),
        Self(Work::of([
            7294, 4319, 1416, 3746, 0, 13243, 2512, 0, 628, 5986, 0, 3780, 7819, 17817, 1047, 36163, 0, 1790, 1348, 1805, 20, 0,
            2793, 3036, 185, 810, 0, 0,
        ])),
        Self(Work::of([
            7294, 5305, 0, 3889, 1560, 11398, 3877, 0, 771, 6272, 0, 3947, 7950, 17674, 706, 18641, 93, 1943, 1348, 1653, 20, 0,
            2240, 2964, 669, 0, 0, 0,
        ])),
        Self(Work::of([
            7294, 5305, 0, 3889, 1560, 11398, 3807, 0, 771, 6272, 0, 3949, 7949, 17674, 914, 13789, 96, 1817, 1383, 1779, 20, 0,
            1798, 3236, 54, 0, 0, 0,
        ])),
    ];
}
