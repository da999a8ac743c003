"""Diffuse scattering by two correlated rough layers, as BornAgain computes it; the intensities of a few pixels."""
import bornagain as ba
from bornagain import angstrom, deg, nm

roughness = ba.LayerRoughness(1 * nm, 0.3, 5 * nm)
vacuum = ba.HomogeneousMaterial("vacuum", 0, 0)
a = ba.HomogeneousMaterial("a", 5e-6, 0)
b = ba.HomogeneousMaterial("b", 1e-5, 0)
substrate = ba.HomogeneousMaterial("substrate", 1.5e-5, 0)
sample = ba.MultiLayer()
sample.addLayer(ba.Layer(vacuum))
sample.addLayerWithTopRoughness(ba.Layer(a, 2.5 * nm), roughness)
sample.addLayerWithTopRoughness(ba.Layer(b, 5 * nm), roughness)
sample.addLayerWithTopRoughness(ba.Layer(substrate), roughness)
sample.setCrossCorrLength(10 * nm)

beam = ba.Beam(1, 1 * angstrom, ba.Direction(0.2 * deg, 0 * deg))
detector = ba.SphericalDetector(3, -0.5 * deg, 0.5 * deg, 3, 0 * deg, 1 * deg)
simulation = ba.GISASSimulation(beam, sample, detector)
simulation.runSimulation()
print(*(f"{x:.17g}" for x in simulation.result().array().flatten()))
