// The look of the view and the cut. K3D calls this text when the view is ready; `K3DInstance` is the view.
const facts = JSON.parse(document.getElementById("facts").textContent);
const dark = matchMedia("(prefers-color-scheme: dark)");
const paint = () => {
  K3DInstance.setClearColor(dark.matches ? 0x16191e : 0xffffff);
  K3DInstance.setLabelColor(dark.matches ? 0xe4e6ea : 0x22252b);
  K3DInstance.render();
};
const axis = document.getElementById("axis"), cut = document.getElementById("cut");
// Removes the part of the specimen that is nearest to the eye at the start: low y, or high x or z.
const clip = () => {
  const k = axis.selectedIndex, part = Number(cut.value), normal = [0, 0, 0];
  normal[k] = k === 1 ? 1 : -1;
  K3DInstance.setClippingPlanes(part > 0 ? [[...normal, (k === 1 ? -part : 1 - part) * facts.box_mm[k]]] : []);
  K3DInstance.render();
};
dark.addEventListener("change", paint);
axis.addEventListener("change", clip);
cut.addEventListener("input", clip);
paint();
document.documentElement.dataset.ready = "yes";  // the view is drawn; tests wait for it
