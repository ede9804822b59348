// Diffuse light varies so little that vertices carry it: at low always, so that the fragment stage stays inside 16 uniform
// vectors; at console where the normal is the vertices' own, 27 multiply-adds a fragment less. A map or a back face gives
// fragments normals that no vertex has. The reference tier takes no such step.
#if defined(TIER_LOW) || (defined(TIER_CONSOLE) && !defined(NORMAL_MAP) && !defined(DOUBLE_SIDED))
#define IRRADIANCE_BY_VERTEX
#endif
