document.getElementById("main")!.textContent = "report";
