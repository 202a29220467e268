/* sky/sun_time.h -- the two times that the sun's place depends on. */
#ifndef SKY_SUN_TIME_H
#define SKY_SUN_TIME_H

/* Days of universal time (how far Earth has turned) and of terrestrial time (how far it has moved)
 * since 2000-01-01T00:00 of each. */
double sun_universal_days(double moment);
double sun_terrestrial_days(double moment);

#endif
