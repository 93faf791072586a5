/// constants.glsl - the only pi.
const float PI = 3.14159265358979324;
const float TWO_PI = 6.28318530717958648;
const float HALF_PI = 1.57079632679489662;
const float INV_PI = 0.318309886183790672;
const float INV_TWO_PI = 0.159154943091895336;
const float INV_FOUR_PI = 0.0795774715459476679;
