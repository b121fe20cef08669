// Before anything is drawn: day or night, as was chosen here before, else as the system has it.
{
  const night = matchMedia("(prefers-color-scheme: dark)");
  const show = () => {
    const chosen = localStorage.getItem("pluto-theme");
    document.documentElement.dataset.theme = chosen ?? (night.matches ? "dark" : "light");
  };
  night.addEventListener("change", show);
  document.addEventListener("theme", show);
  show();
}
