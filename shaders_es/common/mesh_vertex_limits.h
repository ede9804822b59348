// Sizes of joint palettes: numbers that shaders and C++ share.

/* Joints of one mesh at the low tier. 72 vectors of three a joint; with the 48 that surface.vert may use beside them they
   fit the 128 that every ES 2.0 device has. */
#define JOINTS_SMALL 24

/* Joints of one mesh above low. 192 vectors; with the 32 that surface.vert may use beside them they fit the 256 that
   every ES 3.0 device has. */
#define JOINTS_LARGE 64

/* Joints in one row of a palette texture: 48 texels, so that 16384 joints fit 1024 rows. */
#define JOINTS_A_ROW 16
