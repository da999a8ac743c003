//! Studies as they are read, certified and sampled.
